/// An HDF5 file in the few words that the results need: whole arrays, arrays that grow by rows, marks on
/// groups, and links to other files. Every status code of the library is checked; what fails says which file
/// and which object. A file that has its name never changes any more: it is replaced by a new or a revised
/// one, so that it can be read at any moment, whatever crashes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "output/replace.hpp"

namespace fpi::output {

using Shape = std::vector<std::size_t>;

/// Paths inside the file are absolute, such as "/steps/000000/velocity"; groups on the way are made. All
/// functions throw Error naming the file where the library reports a failure or where an object is not as
/// described.
class H5File {
 public:
  static H5File replacing(const std::string& path);  ///< an empty file, to be published at `path`
  static H5File revising(
      const std::string& path);  ///< a copy of the file there, to be published in its place
  static H5File read(const std::string& path);
  ~H5File();
  H5File(H5File&&) noexcept;
  H5File& operator=(H5File&&) noexcept;

  const std::string& path() const { return path_; }
  /// Closes the file and gives it its name. Without it, what was written is lost.
  void publish(Durable durable);

  /// Writes a new array; `shape` multiplies to the number of values, row-major.
  void write(const std::string& name, std::span<const double> values, const Shape& shape);
  void write(const std::string& name, std::span<const std::uint32_t> values, const Shape& shape);
  void write(const std::string& name, std::span<const std::uint8_t> bytes);
  void write(const std::string& name, const std::vector<std::string>& texts);

  /// Adds rows to an array that grows along its first index; the first call makes it. `row_shape` is the
  /// shape of a row: {} for a number.
  void append(const std::string& name, std::span<const double> rows, const Shape& row_shape);
  /// Keeps the first `rows` rows of such an array, which must have as many.
  void keep_rows(const std::string& name, std::size_t rows);

  /// Marks a group ("/": the file) with a number.
  void mark(const std::string& group, const std::string& attribute, double value);
  /// Makes a group that is the top group of another file, named as seen from the folder of this one.
  void link(const std::string& name, const std::string& file);

  bool has(const std::string& name) const;
  std::vector<std::string> list(const std::string& group) const;  ///< names in the group, in order
  double attribute(const std::string& name, const std::string& attribute) const;
  Shape shape(const std::string& name) const;
  std::vector<double> doubles(const std::string& name) const;
  std::vector<std::uint32_t> indices(const std::string& name) const;
  std::vector<std::uint8_t> bytes(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;

 private:
  H5File(std::string path, std::int64_t id) : path_(std::move(path)), id_(id) {}
  void resize(const std::string& name, std::size_t rows);
  [[noreturn]] void failed(const char* what, const std::string& name) const;
  std::int64_t checked(std::int64_t status, const char* what, const std::string& name) const;
  void write_array(const std::string& name, std::int64_t type, const void* values, std::size_t count,
                   const Shape& shape);
  template <class T>
  std::vector<T> read_array(const std::string& name, std::int64_t type) const;

  std::string path_;
  std::int64_t id_ = -1;  ///< HDF5's hid_t
};

}  // namespace fpi::output
