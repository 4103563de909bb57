/// From the declarations to a Markdown table of all keys. docs/scene_reference.md is this text; a test
/// compares them.
#include <fmt/format.h>

#include "scene/scene.hpp"
#include "scene/toml_text.hpp"

namespace fpi::scene {
namespace {

/// Walks the declarations of a scene with one of everything and describes each key.
class Reference : public ParameterVisitor {
 public:
  Reference() { columns(); }
  const std::string& markdown() const { return out_; }

  void real(const Parameter& p, double& value, Bounds bounds) override {
    row(p, toml_text(value), describe(bounds));
  }
  void real(const Parameter& p, std::optional<double>&, Bounds bounds) override {
    row(p, "", describe(bounds));
  }
  void integer(const Parameter& p, std::int64_t& value, Bounds bounds) override {
    row(p, toml_text(value), join("whole", describe(bounds)));
  }
  void boolean(const Parameter& p, bool& value) override { row(p, toml_text(value), "true, false"); }
  void text(const Parameter& p, std::string& value) override { row(p, toml_text(value), "text"); }
  void formula(const Parameter& p, std::string& value) override { row(p, toml_text(value), "formula"); }
  void formula(const Parameter& p, std::optional<std::string>&) override { row(p, "", "formula"); }
  void choice(const Parameter& p, std::string& value, std::span<const std::string_view> choices) override {
    row(p, toml_text(value), describe(choices));
  }
  void reals(const Parameter& p, std::vector<double>& values, Count count, Bounds bounds) override {
    row(p, toml_text(values), join(join(describe(count), "numbers"), describe(bounds)));
  }
  void texts(const Parameter& p, std::vector<std::string>& values, Count count) override {
    row(p, toml_text(values), join(describe(count), "texts"));
  }
  void formulas(const Parameter& p, std::vector<std::string>& values, Count count) override {
    row(p, toml_text(values), join(describe(count), "formulas"));
  }
  void require(bool, std::string_view, std::string_view) override {}

 protected:
  bool begin_table(const Parameter& p, bool) override {
    section(enter(p.key), "[{}]", p.text);
    return true;
  }
  std::size_t begin_tables(const Parameter&, std::size_t) override { return 1; }
  void begin_entry(const Parameter& p, std::size_t) override { section(enter(p.key), "[[{}]]", p.text); }
  std::vector<std::string> begin_named(const Parameter& p, const std::vector<std::string>&) override {
    enter(p.key);
    return {"NAME"};
  }
  void begin_name(const Parameter& p, const std::string& name) override {
    section(enter(name), "[{}]", p.text);
  }
  void end_table() override { paths_.pop_back(); }

 private:
  static std::string join(std::string_view a, std::string_view b) {
    return fmt::format("{}{}{}", a, a.empty() || b.empty() ? "" : " ", b);
  }
  const std::string& enter(std::string_view key) {
    return paths_.emplace_back(paths_.empty() ? std::string(key) : fmt::format("{}.{}", paths_.back(), key));
  }
  void columns() { out_ += "| key | unit | default | allowed | meaning |\n|---|---|---|---|---|\n"; }
  void section(const std::string& path, fmt::format_string<const std::string&> brackets,
               std::string_view text) {
    out_ += fmt::format("\n## `{}`\n{}.\n\n", fmt::format(brackets, path), sentence(text));
    columns();
  }
  void row(const Parameter& p, const std::string& value, const std::string& allowed) {
    out_ += fmt::format("| `{}` | {} | {} | {} | {} |\n", p.key, p.unit,
                        p.required      ? "required"
                        : value.empty() ? "none"
                                        : "`" + value + "`",
                        allowed, p.text);
  }
  static std::string sentence(std::string_view text) {
    std::string out(text);
    if (!out.empty() && out[0] >= 'a' && out[0] <= 'z') out[0] = static_cast<char>(out[0] - 'a' + 'A');
    return out;
  }

  std::string out_ =
      "# Scene reference\n\nAll keys of a scene file (TOML), made from the declarations in `common/scene`. "
      "SI units; "
      "a formula is text in `x`, `y`, `t` and `pi`, or a number.\n\n";
  std::vector<std::string> paths_;
};

}  // namespace

std::string reference() {
  Scene scene;
  Reference walk;
  scene.declare(walk);
  return walk.markdown();
}

}  // namespace fpi::scene
