/// Formulas: what is taken has a finite value or says where it has none.
#include <cmath>

#include "core/expression.hpp"
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fpi;
  const std::string formula(fuzz::text(data, size));
  fuzz::takes_or_refuses("formula", [&] {
    const Expression expression(formula);
    for (const double t : {0.0, 0.1, 1e3})
      if (!std::isfinite(expression(0.25, -0.5, t))) fuzz::fault("a value that is not finite: " + formula);
  });
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() {
  std::vector<Bytes> out;
  for (const std::string_view formula :
       {"0", "1.5e-3", "4*0.3*y*(0.41-y)/0.41^2", "sin(2*pi*t)", "t < 0.35 ? 1 : 0",
        "exp(-t)*cos(pi*x)*sin(pi*y)", "sqrt(x^2 + y^2)", "min(t, 1, x)", "-x", "(t > 1) && (t < 2)",
        "ln(1 + t) + atan2(y, x)", "sum(1, x, y)"})
    out.emplace_back(formula.begin(), formula.end());
  return out;
}

std::vector<std::string> words() {
  return {"x",  "y",  "t", "pi", "sin(", "min(", ",",   "=",     "?",  ":",
          "&&", "||", "^", "(",  ")",    "_e",   "0,5", "\"a\"", "1/0"};
}

}  // namespace fpi::fuzz
