/// An HDF5 file in the few words that the results need: whole arrays, arrays that grow by rows, and marks on
/// groups. Every status code of the library is checked; what fails says which file and which object.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fpi::output {

using Shape = std::vector<std::size_t>;

/// Paths inside the file are absolute, such as "/steps/000000/velocity"; groups on the way are made. All
/// functions throw Error naming the file where the library reports a failure or where an object is not as
/// described.
class H5File {
 public:
  static H5File create(const std::string& path);  ///< replaces a file that is there
  static H5File edit(const std::string& path);    ///< opens to read and write
  static H5File read(const std::string& path);    ///< opens to read
  ~H5File();
  H5File(H5File&&) noexcept;
  H5File& operator=(H5File&&) noexcept;

  const std::string& path() const { return path_; }

  /// Writes a new array; `shape` multiplies to the number of values, row-major.
  void write(const std::string& name, std::span<const double> values, const Shape& shape);
  void write(const std::string& name, std::span<const std::uint32_t> values, const Shape& shape);
  void write(const std::string& name, std::span<const std::uint8_t> bytes);
  void write(const std::string& name, const std::vector<std::string>& texts);

  /// Adds one row to an array that grows along its first index; the first call makes it.
  /// `row_shape` is the shape of a row: {} for a number.
  void append(const std::string& name, std::span<const double> row, const Shape& row_shape);
  /// Keeps the first `rows` rows of such an array, which must have as many.
  void keep_rows(const std::string& name, std::size_t rows);

  /// Makes a group and marks it with a number.
  void make_group(const std::string& name, const std::string& attribute, double value);
  void remove(const std::string& name);

  bool has(const std::string& name) const;
  std::vector<std::string> list(const std::string& group) const;  ///< names in the group, in order
  double attribute(const std::string& name, const std::string& attribute) const;
  Shape shape(const std::string& name) const;
  std::vector<double> doubles(const std::string& name) const;
  std::vector<std::uint32_t> indices(const std::string& name) const;
  std::vector<std::uint8_t> bytes(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;

  /// Hands all to the operating system: from here on the file outlives a crash of this process.
  void flush();

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
