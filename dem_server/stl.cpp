#include "stl.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"
#include "core/tokenizer.hpp"

namespace fpi::dem {
namespace {

constexpr std::size_t head = 80, counted_head = 84, per_triangle = 50,
                      normal = 12;  ///< bytes of a binary file

template <class Number>
Number little_endian(std::string_view bytes, std::size_t at) {
  static_assert(std::endian::native == std::endian::little);
  Number value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Triangles that the head of a binary file announces.
std::size_t announced(std::string_view bytes) {
  return bytes.size() < counted_head ? 0 : little_endian<std::uint32_t>(bytes, head);
}

std::size_t announced_size(std::string_view bytes) { return counted_head + per_triangle * announced(bytes); }

/// Text begins with "solid", as the head of some binary files does: these have a size that fits, or zeros.
bool is_binary(std::string_view bytes) {
  if (announced(bytes) > 0 && bytes.size() == announced_size(bytes)) return true;
  Tokenizer words(bytes, "", "");
  return words.at_end() || !Tokenizer::same(words.word(), "solid") ||
         bytes.substr(0, counted_head).find('\0') != bytes.npos;
}

std::vector<Corners> read_binary(std::string_view bytes, const std::string& name) {
  const std::size_t n = announced(bytes), size = announced_size(bytes);
  require(bytes.size() >= counted_head && n > 0,
          "{}: an STL file with a triangle is required, text that begins with \"solid\" or binary; got {} "
          "bytes that "
          "are neither: write it anew",
          name, bytes.size());
  require(bytes.size() >= size,
          "{}: a whole binary STL file is required; got {} bytes where {} triangles take {}: it was cut "
          "short, or is "
          "no STL file",
          name, bytes.size(), n, size);
  require(bytes.size() < size + per_triangle,
          "{}: a binary STL file that counts its triangles is required; got a count of {} in a file with "
          "room for "
          "{}: write it anew",
          name, n, (bytes.size() - counted_head) / per_triangle);
  std::vector<Corners> triangles(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t at = counted_head + per_triangle * i + normal;
    for (Vec3& corner : triangles[i])
      for (double& coordinate : corner) {
        coordinate = static_cast<double>(little_endian<float>(bytes, at));
        at += sizeof(float);
        require(std::isfinite(coordinate),
                "{}: an STL file of finite numbers is required; triangle {} has others: write it anew", name,
                i + 1);
      }
  }
  return triangles;
}

Corners read_facet(Tokenizer& in) {
  in.expect("normal");
  in.skip(3);
  in.expect("outer");
  in.expect("loop");
  Corners corners;
  for (Vec3& corner : corners) {
    in.expect("vertex");
    for (double& coordinate : corner) coordinate = in.real();
  }
  in.expect("endloop");
  in.expect("endfacet");
  return corners;
}

std::vector<Corners> read_text(std::string_view text, const std::string& name) {
  Tokenizer in(text, name, "write the STL file anew");
  std::vector<Corners> triangles;
  while (!in.at_end()) {
    in.expect("solid");
    in.skip_line();  // its name
    while (true) {
      const std::string_view word = in.word();
      if (Tokenizer::same(word, "endsolid")) break;
      if (!Tokenizer::same(word, "facet")) in.bad("facet or endsolid", printable(word));
      triangles.push_back(read_facet(in));
    }
    in.skip_line();
  }
  require(!triangles.empty(), "{}: an STL file with a triangle is required; got none: write it anew", name);
  return triangles;
}

/// Single precision is too coarse for a mesh that is small against its distance from the origin.
std::string precision_note(const std::vector<Corners>& triangles, const std::string& name) {
  constexpr double coarse = 1e-5;  // of the mesh
  Eigen::AlignedBox3d box;
  for (const Corners& corners : triangles)
    for (const Vec3& corner : corners) box.extend(corner);
  const auto farthest =
      static_cast<float>(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()));
  const double spacing = static_cast<double>(std::nextafter(farthest, 2 * farthest) - farthest);
  if (spacing <= coarse * box.diagonal().norm()) return "";
  return fmt::format(
      "{}: a binary STL file holds single precision: its coordinates are rounded to {:.2g}, and the mesh is "
      "{:.3g} "
      "across; write it as text, or closer to the origin",
      name, spacing, box.diagonal().norm());
}

}  // namespace

StlMesh read_stl(std::string_view bytes, const std::string& name) {
  if (!is_binary(bytes)) return {.triangles = read_text(bytes, name), .note = ""};
  std::vector<Corners> triangles = read_binary(bytes, name);
  std::string note = precision_note(triangles, name);
  return {.triangles = std::move(triangles), .note = std::move(note)};
}

}  // namespace fpi::dem
