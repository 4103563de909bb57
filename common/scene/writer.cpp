/// From a scene to canonical TOML, every default filled in. The text of two scenes is equal where they mean
/// the same, which is what the fingerprint rests on.
#include <fmt/format.h>

#include "scene/scene.hpp"
#include "scene/toml_text.hpp"

namespace fpi::scene {
namespace {

/// Walks the declarations and writes each value under its table's header.
class Writer : public ParameterVisitor {
 public:
  const std::string& text_so_far() const { return out_; }

  void real(const Parameter& p, double& value, Bounds) override { line(p, value); }
  void real(const Parameter& p, std::optional<double>& value, Bounds) override {
    if (value) line(p, *value);
  }
  void integer(const Parameter& p, std::int64_t& value, Bounds) override { line(p, value); }
  void boolean(const Parameter& p, bool& value) override { line(p, value); }
  void text(const Parameter& p, std::string& value) override { line(p, value); }
  void formula(const Parameter& p, std::string& value) override { line(p, value); }
  void formula(const Parameter& p, std::optional<std::string>& value) override {
    if (value) line(p, *value);
  }
  void choice(const Parameter& p, std::string& value, std::span<const std::string_view>) override {
    line(p, value);
  }
  void reals(const Parameter& p, std::vector<double>& values, Count, Bounds) override { line(p, values); }
  void texts(const Parameter& p, std::vector<std::string>& values, Count) override { line(p, values); }
  void formulas(const Parameter& p, std::vector<std::string>& values, Count) override { line(p, values); }
  void require(bool, std::string_view, std::string_view) override {}

 protected:
  bool begin_table(const Parameter& p, bool exists) override {
    if (exists) header("[", enter(p.key), "]");
    return exists;
  }
  std::size_t begin_tables(const Parameter&, std::size_t count) override { return count; }
  void begin_entry(const Parameter& p, std::size_t) override { header("[[", enter(p.key), "]]"); }
  std::vector<std::string> begin_named(const Parameter& p, const std::vector<std::string>& names) override {
    enter(p.key);
    return names;
  }
  void begin_name(const Parameter&, const std::string& name) override {
    header("[", enter(toml_key(name)), "]");
  }
  void end_table() override { paths_.pop_back(); }

 private:
  template <class T>
  void line(const Parameter& p, const T& value) {
    out_ += fmt::format("{} = {}\n", p.key, toml_text(value));
  }
  const std::string& enter(std::string_view key) {
    return paths_.emplace_back(paths_.empty() ? std::string(key) : fmt::format("{}.{}", paths_.back(), key));
  }
  void header(std::string_view open, const std::string& path, std::string_view close) {
    out_ += fmt::format("\n{}{}{}\n", open, path, close);
  }

  std::string out_;
  std::vector<std::string> paths_;
};

}  // namespace

std::string write_text(const Scene& scene) {
  Scene copy = scene;  // a declaration names members that may be written
  copy.bodies.resize(scene.n_listed());
  Writer writer;
  copy.declare(writer);
  return writer.text_so_far();
}

}  // namespace fpi::scene
