// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A virtual file driver of HDF5 ("VFD", RM_H5FD of its reference manual) over a ByteSource, and the
// library's errors.
#include "io/hdf5/hdf5_file.h"

#include <hdf5.h>

#include <limits>

#include "kernels/core/error.h"

namespace mw::io {
namespace {

herr_t keep_first(unsigned, const H5E_error2_t* error, void* out) {
  auto& reason = *static_cast<std::string*>(out);
  if (reason.empty() && error->desc != nullptr) reason = error->desc;
  return 0;
}

}  // namespace

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, &keep_first, &reason);
  return reason.empty() ? "no reason given" : reason;
}

std::optional<Hdf5Elsewhere> stored_elsewhere(hid_t object, hid_t set) {
  H5O_info_t here{}, there{};
  if (H5Oget_info2(object, &here, H5O_INFO_BASIC) < 0 ||
      H5Oget_info2(set, &there, H5O_INFO_BASIC) < 0) {
    return Hdf5Elsewhere{"its header cannot be read", kHdf5Damaged};
  }
  if (here.fileno != there.fileno) {
    return Hdf5Elsewhere{"a link leads to another file", "give that file"};
  }
  const Hdf5Handle list(H5Dget_create_plist(set), &H5Pclose);
  if (!list.valid()) return Hdf5Elsewhere{"its storage is unknown", kHdf5Damaged};
  if (H5Pget_layout(list.get()) == H5D_VIRTUAL) {
    return Hdf5Elsewhere{"its numbers are in other files (a virtual data set)",
                         "copy it into one file: h5py's out['name'] = file['name'][()]"};
  }
  if (H5Pget_external_count(list.get()) != 0) {
    return Hdf5Elsewhere{"its numbers are in other files (external storage)",
                         "h5repack it into one file"};
  }
  return std::nullopt;
}

namespace {

/// An open file, of which the library sees the first member only.
struct OpenFile {
  H5FD_t base;
  Hdf5Source* source;
  haddr_t allocated;  ///< where the file ends for the library ("EOA")
};

OpenFile& ours(H5FD_t* file) {
  return *reinterpret_cast<OpenFile*>(file);
}
const OpenFile& ours(const H5FD_t* file) {
  return *reinterpret_cast<const OpenFile*>(file);
}

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const auto* source = static_cast<Hdf5Source* const*>(H5Pget_driver_info(access));
  if (source == nullptr) return nullptr;
  return &(new OpenFile{.base = {}, .source = *source, .allocated = 0})->base;
}

herr_t close_file(H5FD_t* file) {
  delete &ours(file);
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t) {
  return ours(file).allocated;
}

herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  ours(file).allocated = end;
  return 0;
}

haddr_t file_end(const H5FD_t* file, H5FD_mem_t) {
  return ours(file).source->bytes->size();
}

// More than five parameters, here and below: the library's table of functions has them.
herr_t read(H5FD_t* file, H5FD_mem_t what, hid_t, haddr_t from, std::size_t size, void* buffer) {
  Hdf5Source& source = *ours(file).source;
  if (what == H5FD_MEM_DRAW && source.only_note_data) {
    source.noted = Hdf5Source::Place{from, size};
    return 0;
  }
  try {
    source.bytes->read_at(from, {static_cast<std::byte*>(buffer), size});
  } catch (const Error&) {
    return -1;
  }
  return 0;
}

herr_t refuse_to_write(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, std::size_t, const void*) {
  return -1;
}

hid_t register_driver() {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION  // HDF5 1.14 registers no driver without it
  driver.version = H5FD_CLASS_VERSION;
#endif
  driver.name = "mwmesh_source";
  driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<std::int64_t>::max());
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(void*);  // the address of the source
  driver.open = &open_file;
  driver.close = &close_file;
  driver.get_eoa = &allocated;
  driver.set_eoa = &allocate;
  driver.get_eof = &file_end;
  driver.read = &read;
  driver.write = &refuse_to_write;
  return H5FDregister(&driver);
}

}  // namespace

Hdf5Handle access_from(Hdf5Source& source) {
  static const hid_t driver = register_driver();
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  const Hdf5Source* const info = &source;
  if (!access.valid() || H5Pset_driver(access.get(), driver, &info) < 0) return {};
  return access;
}

}  // namespace mw::io
