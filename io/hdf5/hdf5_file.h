// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is shared by all who ask the HDF5 library: owned identifiers, a file that is read through a
// ByteSource, and why a call failed.
#pragma once

#include <hdf5.h>

#include <optional>
#include <string>
#include <utility>

#include "io/file/source/byte_source.h"

namespace mw::io {

/// An HDF5 identifier with the function that closes it.  Thread safety: none, like all of Debian's
/// serial HDF5: one thread at a time in the whole process.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() { close(); }

  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }
  /// Closes now; whether that went well.
  bool close() {
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    return id < 0 || close_(id) >= 0;
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// Keeps the library from printing its errors; ours say what matters.  Before any other call.
inline void silence_hdf5() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// The innermost message of the call that failed last: "file signature not found".  Any other call
/// of the library forgets it.
[[nodiscard]] std::string hdf5_reason();

/// A file that the library reads.
struct Hdf5Source {
  const ByteSource* bytes = nullptr;
  /// Raw data (not metadata) are not read; where they would have been is noted.  The library has no
  /// other quick way to tell: H5Dget_chunk_info_by_coord goes through all chunks for each.
  bool only_note_data = false;

  struct Place {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
  };
  std::optional<Place> noted;  ///< the last one
};

/// A file access property list for H5Fopen to read, whose file name is then ignored.
/// REQUIRES: source and its bytes outlive the HDF5 file.
[[nodiscard]] Hdf5Handle access_from(Hdf5Source& source);

}  // namespace mw::io
