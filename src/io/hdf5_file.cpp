#include "hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <cstring>
#include <mutex>
#include <utility>

#include "hexfield/base/error.hpp"
#include "hexfield/io/checkpoint.hpp"

namespace hexfield::hdf5 {
namespace {

/// Closes an HDF5 handle at the end of its scope.
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

/// HDF5 reports to us only.
void quiet() {
  static std::once_flag once;
  std::call_once(once, [] { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); });
}

hid_t memory_type(ElementType type) {
  switch (type) {
    case ElementType::float64:
      return H5T_NATIVE_DOUBLE;
    case ElementType::int32:
      return H5T_NATIVE_INT32;
    case ElementType::int64:
      return H5T_NATIVE_INT64;
    case ElementType::uint8:
      return H5T_NATIVE_UINT8;
  }
  return -1;
}

hid_t file_type(ElementType type) {
  switch (type) {
    case ElementType::float64:
      return H5T_IEEE_F64LE;
    case ElementType::int32:
      return H5T_STD_I32LE;
    case ElementType::int64:
      return H5T_STD_I64LE;
    case ElementType::uint8:
      return H5T_STD_U8LE;
  }
  return -1;
}

template <class T>
NamedArray read_rows(hid_t dataset, std::size_t rows, std::size_t columns, bool& good) {
  auto values = std::make_shared<std::vector<T>>(rows * columns);
  const ElementType type = element_type<T>();
  good = values->empty() || H5Dread(dataset, memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values->data()) >= 0;
  return {type, rows, columns, values->data(), values};
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

std::vector<std::string> links(hid_t location) {
  std::vector<std::string> names;
  H5Literate(location, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names);
  return names;
}

}  // namespace

void File::fail(const std::string& what) const {
  throw Error(ExitCode::bad_input, fmt::format("The checkpoint {} {}.", path_.string(), what));
}

File File::create(const std::filesystem::path& path) {
  quiet();
  Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_userblock(creation, user_block_size);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V110);
  constexpr std::size_t growth = std::size_t{16} << 20;
  H5Pset_fapl_core(access, growth, false);
  File file(path, H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access));
  if (file.id_ < 0) file.fail("cannot be made in memory");
  return file;
}

File File::open(const std::filesystem::path& path) {
  quiet();
  File file(path, H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (file.id_ < 0) file.fail("cannot be opened as HDF5");
  return file;
}

File::File(File&& other) noexcept : path_(std::move(other.path_)), id_(std::exchange(other.id_, -1)) {}

File::~File() {
  if (id_ >= 0) H5Fclose(id_);
}

std::span<std::byte> File::image() {
  void* handle = nullptr;
  // The size that is used, behind the user block; what the driver holds is larger.
  const ssize_t used = H5Fflush(id_, H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(id_, nullptr, 0);
  if (used < 0 || H5Fget_vfd_handle(id_, H5P_DEFAULT, &handle) < 0 || handle == nullptr)
    fail("cannot be made in memory");
  // The handle of the memory driver is the address of its pointer to the bytes.
  return {*static_cast<std::byte**>(handle), static_cast<std::size_t>(used) + user_block_size};
}

void File::make_group(const std::string& group) {
  Handle made(H5Gcreate2(id_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (made < 0) fail("cannot be made in memory");
}

std::vector<std::string> File::groups() const { return links(id_); }

bool File::has_attribute(const std::string& group, const std::string& attribute) const {
  return H5Aexists_by_name(id_, group.c_str(), attribute.c_str(), H5P_DEFAULT) > 0;
}

void File::set_text(const std::string& group, const std::string& attribute, const std::string& text) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, text.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  Handle made(
      H5Acreate_by_name(id_, group.c_str(), attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (made < 0 || H5Awrite(made, type, text.c_str()) < 0) fail("cannot be made in memory");
}

std::string File::get_text(const std::string& group, const std::string& attribute) const {
  Handle found(H5Aopen_by_name(id_, group.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  Handle type(found < 0 ? -1 : H5Aget_type(found), H5Tclose);
  if (type < 0 || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) {
    fail(fmt::format("lacks the text '{}' of group {}", attribute, group));
  }
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(found, type, text.data()) < 0) fail(fmt::format("does not give the text '{}'", attribute));
  text.resize(std::strlen(text.c_str()));
  return text;
}

void File::write(const std::string& group, const std::string& name, const NamedArray& array) {
  const hsize_t shape[2] = {array.rows, array.columns};
  Handle space(H5Screate_simple(array.columns == 1 ? 1 : 2, shape, nullptr), H5Sclose);
  Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  const std::string path = group + "/" + name;
  Handle dataset(H5Dcreate2(id_, path.c_str(), file_type(array.type), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                 H5Dclose);
  const bool empty = array.rows == 0;
  if (dataset < 0 ||
      (!empty && H5Dwrite(dataset, memory_type(array.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.data) < 0)) {
    fail("cannot be made in memory");
  }
}

NamedArrays File::read(const std::string& group) const {
  NamedArrays arrays;
  Handle location(H5Gopen2(id_, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (location < 0) fail(fmt::format("has no group '{}'", group));
  for (const std::string& name : links(location)) {
    Handle dataset(H5Dopen2(location, name.c_str(), H5P_DEFAULT), H5Dclose);
    Handle space(dataset < 0 ? -1 : H5Dget_space(dataset), H5Sclose);
    Handle type(dataset < 0 ? -1 : H5Dget_type(dataset), H5Tclose);
    const int rank = space < 0 ? 0 : H5Sget_simple_extent_ndims(space);
    if (rank < 1 || rank > 2) fail(fmt::format("has an array '{}' of unknown shape", name));
    hsize_t shape[2] = {0, 1};
    H5Sget_simple_extent_dims(space, shape, nullptr);
    bool good = false;
    NamedArray array;
    if (H5Tequal(type, H5T_IEEE_F64LE) > 0) array = read_rows<double>(dataset, shape[0], shape[1], good);
    if (H5Tequal(type, H5T_STD_I32LE) > 0) array = read_rows<std::int32_t>(dataset, shape[0], shape[1], good);
    if (H5Tequal(type, H5T_STD_I64LE) > 0) array = read_rows<std::int64_t>(dataset, shape[0], shape[1], good);
    if (H5Tequal(type, H5T_STD_U8LE) > 0) array = read_rows<std::uint8_t>(dataset, shape[0], shape[1], good);
    if (!good) fail(fmt::format("does not give its array '{}/{}'", group, name));
    arrays.add(name, std::move(array));
  }
  return arrays;
}

void File::copy_group(const File& from, const std::string& group) {
  if (H5Ocopy(from.id_, group.c_str(), id_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0) {
    fail(fmt::format("cannot take over the stage '{}'", group));
  }
}

}  // namespace hexfield::hdf5

std::string hexfield::hdf5_version() {
  unsigned major = 0;
  unsigned minor = 0;
  unsigned release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}
