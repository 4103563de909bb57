#include "coupling/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

namespace fpi::coupling {
namespace {

constexpr double agreed = 1e-10;  ///< of the largest value met times the step
constexpr int most_halvings = 40;
constexpr int parts = 32;  ///< of a step in which a formula may jump

/// Points and weights of the five-point Gauss–Legendre rule on [0, 1].
struct QuadraturePoint {
  double place, weight;
};
constexpr std::array<QuadraturePoint, 5> quadrature{{{0.04691007703066800, 0.11846344252809454},
                                                     {0.23076534494715845, 0.23931433524968324},
                                                     {0.5, 0.28444444444444444},
                                                     {0.76923465505284155, 0.23931433524968324},
                                                     {0.95308992296933200, 0.11846344252809454}}};

/// The numbers that are written in a formula.
std::vector<double> numbers_in(const std::string& formula) {
  std::vector<double> numbers;
  const char *at = formula.data(), *const end = at + formula.size();
  const auto is_of_name = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  while (at < end) {
    double number = 0;
    if (is_of_name(*at)) {  // log10 has no number
      while (at < end && (is_of_name(*at) || is_digit(*at))) ++at;
    } else if (const auto [rest, problem] = std::from_chars(at, end, number);
               (is_digit(*at) || *at == '.') && problem == std::errc()) {
      numbers.push_back(number);
      at = rest;
    } else {
      ++at;
    }
  }
  return numbers;
}

/// Whether it has an operator or function that may jump or bend.
bool may_jump(const std::string& formula) {
  constexpr std::array words{"<", ">", "=", "?", "rint", "sign", "abs", "min", "max"};
  return std::ranges::any_of(words, [&](const char* word) { return formula.find(word) != formula.npos; });
}

/// t0, t1, and what is between them of the numbers in the formula, in order; equal parts too where it may
/// jump.
std::vector<double> divided(const Expression& formula, double t0, double t1) {
  std::vector<double> times{t0, t1};
  for (int part = 1; part < parts && may_jump(formula.formula()); ++part)
    times.push_back(t0 + (t1 - t0) * part / parts);
  for (const double number : numbers_in(formula.formula()))
    if (number > t0 && number < t1) times.push_back(number);
  std::ranges::sort(times);
  return times;
}

class Adaptive {
 public:
  Adaptive(const Expression& formula, double duration) : formula_(formula), duration_(duration) {}

  double from_to(double a, double b) { return halved(a, b, gauss(a, b), most_halvings); }

 private:
  double gauss(double a, double b) {
    double sum = 0;
    for (const QuadraturePoint& q : quadrature) {
      const double value = formula_(0, 0, a + q.place * (b - a));
      largest_ = std::max(largest_, std::abs(value));
      sum += q.weight * (b - a) * value;
    }
    return sum;
  }

  double halved(double a, double b, double whole, int left) {
    const double middle = 0.5 * (a + b);
    const double first = gauss(a, middle), second = gauss(middle, b);
    if (left == 0 || std::abs(first + second - whole) <= agreed * largest_ * duration_) return whole;
    return halved(a, middle, first, left - 1) + halved(middle, b, second, left - 1);
  }

  const Expression& formula_;
  double duration_;     ///< [s] of all
  double largest_ = 0;  ///< value met
};

}  // namespace

double integral(const Expression& formula, double t0, double t1) {
  if (!formula.depends_on_time()) return (t1 - t0) * formula(0, 0, t0);
  const std::vector<double> times = divided(formula, t0, t1);
  Adaptive adaptive(formula, t1 - t0);
  double sum = 0;
  for (std::size_t k = 1; k < times.size(); ++k) sum += adaptive.from_to(times[k - 1], times[k]);
  return sum;
}

}  // namespace fpi::coupling
