// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What all callers of the HDF5 library share: owned identifiers, a file that is read through a
// ByteSource, and the reason why a call failed.
#pragma once

#include <hdf5.h>

#include <optional>
#include <string>
#include <utility>

#include "io/file/source/byte_source.h"

namespace mw::io {

/// An HDF5 identifier with the function that closes it.  Thread safety: none; only one thread of
/// the process may call Debian's serial HDF5 at a time.
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
  /// Closes now; returns whether that went well.
  bool close() {
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    return id < 0 || close_(id) >= 0;
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// Keeps the library from printing its errors, as ours say what matters.  REQUIRES: called first.
inline void silence_hdf5() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// Returns the innermost message of the call that failed last, such as "file signature not found".
/// Any other call of the library forgets it.
[[nodiscard]] std::string hdf5_reason();

/// What an error about a file that contradicts itself advises.
inline constexpr const char* kHdf5Damaged =
    "the file is damaged: check it with h5dump, or h5repack it";

/// Why numbers are not read: they are not in the file that was opened.
struct Hdf5Elsewhere {
  const char* reason;
  const char* way_out;
};

/// Returns why not all of a data set is in the file of `object`, because it has external storage,
/// is virtual, or was reached by a link to another file; nothing when all is there.  A crafted file
/// could name any file of the user so.  It opens no file, unlike H5Dget_space() and H5Dread(), so
/// these wait until this has returned nothing.
[[nodiscard]] std::optional<Hdf5Elsewhere> stored_elsewhere(hid_t object, hid_t set);

/// A file that the library reads.
struct Hdf5Source {
  const ByteSource* bytes = nullptr;
  /// Whether raw data (not metadata) are not read but only their place is noted.  The library has
  /// no other quick way to tell it: H5Dget_chunk_info_by_coord goes through all chunks for each.
  bool only_note_data = false;

  struct Place {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
  };
  std::optional<Place> noted;  ///< the last such place
};

/// Returns a file access property list with which H5Fopen reads the source and ignores its file
/// name.
/// REQUIRES: source and its bytes outlive the HDF5 file.
[[nodiscard]] Hdf5Handle access_from(Hdf5Source& source);

}  // namespace mw::io
