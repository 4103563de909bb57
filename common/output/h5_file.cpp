#include "output/h5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace fpi::output {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>);

constexpr std::size_t chunk_bytes = 16384;  ///< of arrays that grow; each flush writes the last chunk again

/// Owns one HDF5 handle of any kind.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Errors are reported by us, in one sentence, not by HDF5's stack on the terminal.
void silence_library() {
  [[maybe_unused]] static const herr_t once = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

std::vector<hsize_t> to_hsize(const Shape& shape) { return {shape.begin(), shape.end()}; }

std::size_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

hid_t create_missing_groups() {
  const hid_t list = H5Pcreate(H5P_LINK_CREATE);
  return list >= 0 && H5Pset_create_intermediate_group(list, 1) >= 0 ? list : H5I_INVALID_HID;
}

/// Without times, so that the same run writes the same bytes.
hid_t dataset_without_times() {
  const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
  return list >= 0 && H5Pset_obj_track_times(list, false) >= 0 ? list : H5I_INVALID_HID;
}

hid_t variable_text() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  const bool set = type >= 0 && H5Tset_size(type, H5T_VARIABLE) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0;
  return set ? type : H5I_INVALID_HID;
}

}  // namespace

H5File H5File::create(const std::string& path) {
  silence_library();
  H5File file(path, H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  require(file.id_ >= 0,
          "a folder that can be written is required for {}; got a refusal: check permissions, free space and "
          "that "
          "no other run writes there",
          path);
  return file;
}

H5File H5File::edit(const std::string& path) {
  silence_library();
  H5File file(path, H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
  require(file.id_ >= 0, "a whole HDF5 file that can be written is required at {}; it cannot be opened",
          path);
  return file;
}

H5File H5File::read(const std::string& path) {
  silence_library();
  H5File file(path, H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  require(file.id_ >= 0, "a whole HDF5 file is required at {}; it is missing or damaged", path);
  return file;
}

H5File::~H5File() {
  if (id_ >= 0) H5Fclose(id_);
}
H5File::H5File(H5File&& other) noexcept : path_(std::move(other.path_)), id_(std::exchange(other.id_, -1)) {}
H5File& H5File::operator=(H5File&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(id_, other.id_);
  return *this;
}

void H5File::failed(const char* what, const std::string& name) const {
  fail("HDF5 could not {} \"{}\" of {}: check free space, and whether the file is one of ours", what, name,
       path_);
}

std::int64_t H5File::checked(std::int64_t status, const char* what, const std::string& name) const {
  if (status < 0) failed(what, name);
  return status;
}

void H5File::write_array(const std::string& name, std::int64_t type, const void* values, std::size_t count,
                         const Shape& shape) {
  require(product(shape) == count,
          "an array of as many values as its shape has is required for {} of {}; got {} for a shape of {}",
          name, path_, count, product(shape));
  const std::vector<hsize_t> size = to_hsize(shape);
  const Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  const Handle links(create_missing_groups(), H5Pclose);
  const Handle layout(dataset_without_times(), H5Pclose);
  const Handle set(
      checked(H5Dcreate2(id_, name.c_str(), type, space, links, layout, H5P_DEFAULT), "create", name),
      H5Dclose);
  if (count > 0) checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write", name);
}

void H5File::write(const std::string& name, std::span<const double> values, const Shape& shape) {
  write_array(name, H5T_NATIVE_DOUBLE, values.data(), values.size(), shape);
}
void H5File::write(const std::string& name, std::span<const std::uint32_t> values, const Shape& shape) {
  write_array(name, H5T_NATIVE_UINT32, values.data(), values.size(), shape);
}
void H5File::write(const std::string& name, std::span<const std::uint8_t> bytes) {
  write_array(name, H5T_NATIVE_UINT8, bytes.data(), bytes.size(), {bytes.size()});
}
void H5File::write(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const Handle type(variable_text(), H5Tclose);
  write_array(name, type, pointers.data(), pointers.size(), {pointers.size()});
}

void H5File::append(const std::string& name, std::span<const double> row, const Shape& row_shape) {
  std::vector<hsize_t> size{0};
  size.insert(size.end(), row_shape.begin(), row_shape.end());
  if (!has(name)) {
    std::vector<hsize_t> most = size, chunk = size;
    most[0] = H5S_UNLIMITED;
    chunk[0] =
        std::max<hsize_t>(1, chunk_bytes / sizeof(double) / std::max<std::size_t>(1, product(row_shape)));
    const Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), most.data()), H5Sclose);
    const Handle layout(dataset_without_times(), H5Pclose);
    checked(H5Pset_chunk(layout, static_cast<int>(chunk.size()), chunk.data()), "chunk", name);
    const Handle links(create_missing_groups(), H5Pclose);
    const Handle made(H5Dcreate2(id_, name.c_str(), H5T_NATIVE_DOUBLE, space, links, layout, H5P_DEFAULT),
                      H5Dclose);
    checked(made, "create", name);
  }
  const std::size_t rows = shape(name)[0];
  resize(name, rows + 1);
  const Handle set(checked(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), "open", name), H5Dclose);
  const Handle in_file(H5Dget_space(set), H5Sclose);
  std::vector<hsize_t> start(size.size(), 0);
  start[0] = rows;
  size[0] = 1;
  checked(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), "extend",
          name);
  const Handle in_memory(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  require(row.size() == product(row_shape), "a row of {} values is required for {} of {}; got {}",
          product(row_shape), name, path_, row.size());
  checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, row.data()), "write", name);
}

void H5File::keep_rows(const std::string& name, std::size_t rows) {
  const std::size_t present = shape(name).at(0);
  require(present >= rows,
          "{} rows are required in {} of {}; got {}: the file does not belong to the checkpoint", rows, name,
          path_, present);
  resize(name, rows);
}

void H5File::resize(const std::string& name, std::size_t rows) {
  std::vector<hsize_t> size = to_hsize(shape(name));
  size[0] = rows;
  const Handle set(checked(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), "open", name), H5Dclose);
  checked(H5Dset_extent(set, size.data()), "resize", name);
}

void H5File::make_group(const std::string& name, const std::string& attribute, double value) {
  const Handle links(create_missing_groups(), H5Pclose);
  const Handle group(checked(H5Gcreate2(id_, name.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), "create", name),
                     H5Gclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle mark(
      checked(H5Acreate2(group, attribute.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT),
              "mark", name),
      H5Aclose);
  checked(H5Awrite(mark, H5T_NATIVE_DOUBLE, &value), "mark", name);
}

void H5File::remove(const std::string& name) {
  checked(H5Ldelete(id_, name.c_str(), H5P_DEFAULT), "remove", name);
}

bool H5File::has(const std::string& name) const {
  // H5Lexists wants every group on the way to exist.
  for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1)) {
    if (H5Lexists(id_, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(id_, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> H5File::list(const std::string& group) const {
  const Handle handle(checked(H5Gopen2(id_, group.c_str(), H5P_DEFAULT), "open", group), H5Gclose);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  checked(H5Literate(handle, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "list", group);
  return names;
}

double H5File::attribute(const std::string& name, const std::string& attribute) const {
  const Handle mark(
      checked(H5Aopen_by_name(id_, name.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), "read", name),
      H5Aclose);
  double value = 0;
  checked(H5Aread(mark, H5T_NATIVE_DOUBLE, &value), "read", name);
  return value;
}

Shape H5File::shape(const std::string& name) const {
  const Handle set(checked(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), "open", name), H5Dclose);
  const Handle space(H5Dget_space(set), H5Sclose);
  std::vector<hsize_t> size(
      static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space), "measure", name)));
  checked(H5Sget_simple_extent_dims(space, size.data(), nullptr), "measure", name);
  return {size.begin(), size.end()};
}

template <class T>
std::vector<T> H5File::read_array(const std::string& name, std::int64_t type) const {
  std::vector<T> values(product(shape(name)));
  const Handle set(checked(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), "open", name), H5Dclose);
  if (!values.empty())
    checked(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read", name);
  return values;
}
std::vector<double> H5File::doubles(const std::string& name) const {
  return read_array<double>(name, H5T_NATIVE_DOUBLE);
}
std::vector<std::uint32_t> H5File::indices(const std::string& name) const {
  return read_array<std::uint32_t>(name, H5T_NATIVE_UINT32);
}
std::vector<std::uint8_t> H5File::bytes(const std::string& name) const {
  return read_array<std::uint8_t>(name, H5T_NATIVE_UINT8);
}
std::vector<std::string> H5File::texts(const std::string& name) const {
  const Handle type(variable_text(), H5Tclose);
  const std::vector<char*> pointers = read_array<char*>(name, type);
  std::vector<std::string> texts(pointers.begin(), pointers.end());
  for (char* pointer : pointers) H5free_memory(pointer);
  return texts;
}

void H5File::flush() { checked(H5Fflush(id_, H5F_SCOPE_LOCAL), "flush", "/"); }

}  // namespace fpi::output
