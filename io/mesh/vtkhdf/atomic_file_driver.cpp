// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A virtual file driver of HDF5 ("VFD", RM_H5FD of its reference manual) over an AtomicFile.
#include "io/mesh/vtkhdf/atomic_file_driver.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace mw::io {
namespace {

/// The library sees the first member only.
struct OpenFile {
  H5FD_t base;
  Hdf5Target* target;
  haddr_t allocated;  ///< end of what the library has given out ("EOA")
  haddr_t written;    ///< end of the file ("EOF")
};

OpenFile& ours(H5FD_t* file) {
  return *reinterpret_cast<OpenFile*>(file);
}
const OpenFile& ours(const H5FD_t* file) {
  return *reinterpret_cast<const OpenFile*>(file);
}

/// Runs action unless an earlier one failed; keeps its error.
template <class Action>
void guarded(Hdf5Target& target, Action action) noexcept {
  if (target.failure) return;
  try {
    action();
  } catch (...) {
    target.failure = std::current_exception();
  }
}

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const auto* target = static_cast<Hdf5Target* const*>(H5Pget_driver_info(access));
  if (target == nullptr) return nullptr;
  return &(new OpenFile{.base = {}, .target = *target, .allocated = 0, .written = 0})->base;
}

herr_t close_file(H5FD_t* file) {
  delete &ours(file);
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t) {
  return ours(file).allocated;
}

herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  ours(file).allocated = end;
  return 0;
}

haddr_t written(const H5FD_t* file, H5FD_mem_t) {
  return ours(file).written;
}

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t from, std::size_t size, void* buffer) {
  Hdf5Target& target = *ours(file).target;
  guarded(target, [&] { target.file->read_at(from, {static_cast<std::byte*>(buffer), size}); });
  return target.failure ? -1 : 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t to, std::size_t size, const void* buffer) {
  OpenFile& open = ours(file);
  guarded(*open.target, [&] {
    open.target->file->write_at(to, {static_cast<const std::byte*>(buffer), size});
  });
  open.written = std::max<haddr_t>(open.written, to + size);
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  OpenFile& open = ours(file);
  if (open.written == open.allocated) return 0;
  guarded(*open.target, [&] { open.target->file->resize(open.allocated); });
  open.written = open.allocated;
  return 0;
}

hid_t register_driver() {
  H5FD_class_t driver{};
  driver.name = "mwmesh";
  driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<std::int64_t>::max());
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(void*);  // the address of the target
  driver.open = &open_file;
  driver.close = &close_file;
  driver.query = &query;
  driver.get_eoa = &allocated;
  driver.set_eoa = &allocate;
  driver.get_eof = &written;
  driver.read = &read;
  driver.write = &write;
  driver.truncate = &truncate;
  return H5FDregister(&driver);
}

}  // namespace

Hdf5Handle access_through(Hdf5Target& target) {
  static const hid_t driver = register_driver();
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  const Hdf5Target* const info = &target;
  if (!access.valid() || H5Pset_driver(access.get(), driver, &info) < 0) return {};
  return access;
}

}  // namespace mw::io
