// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Describes an HDF5 data set in a child process, and checks what the child says.
#include "io/volume/hdf5/describe.h"

#include <algorithm>

#include "io/file/apart.h"
#include "io/file/errors.h"
#include "io/hdf5/library_errors.h"
#include "io/hdf5/source_driver.h"
#include "io/volume/hdf5/catalogue.h"
#include "io/volume/hdf5/describe_apart.h"

namespace mw::io {
namespace {

constexpr const char* kCheckFile = "the file is damaged: check it with h5dump, or h5repack it";

Hdf5Handle open_file(Hdf5Source& source, const std::string& name) {
  silence_hdf5();
  // A file may name filters that the library would load as plugins; none is needed.
  H5PLset_loading_state(0);
  const Hdf5Handle access = access_from(source);
  const hid_t hdf5 = H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.get());
  if (hdf5 < 0) {
    fail_input(name, "HDF5 structure", text("cannot be opened: ", hdf5_reason()),
               "the file is truncated, damaged or still being written (then h5clear -s it)");
  }
  return {hdf5, &H5Fclose};
}

/// "a/b/" is "/a/b".
std::string full_path(const std::string& given) {
  std::string path = given.starts_with('/') ? given : "/" + given;
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return path;
}

bool is_data_set(hid_t hdf5, const std::string& path) {
  const Hdf5Handle object(H5Oopen(hdf5, path.c_str(), H5P_DEFAULT), &H5Oclose);
  return object.valid() && H5Iget_type(object.get()) == H5I_DATASET;
}

bool is_group(hid_t hdf5, const std::string& path) {
  const Hdf5Handle object(H5Oopen(hdf5, path.c_str(), H5P_DEFAULT), &H5Oclose);
  return object.valid() && H5Iget_type(object.get()) == H5I_GROUP;
}

std::string find_data_set(hid_t hdf5, const std::string& wanted, const std::string& file) {
  if (wanted.empty()) {
    if (H5Lexists(hdf5, "VTKHDF", H5P_DEFAULT) > 0) {
      fail_input(file, "group VTKHDF", "the file is a mesh or an image of VTK, no labelled volume",
                 "give the voxels that it was made from, or name an array with --dataset");
    }
    return choose_data_set(list_data_sets(hdf5, "/", file), file);
  }
  std::string path = full_path(wanted);
  if (is_data_set(hdf5, path)) return path;
  if (is_group(hdf5, path)) return choose_data_set(list_data_sets(hdf5, path, file), file);
  fail_input(file, text("data set ", path),
             text("missing; there are: ", list_text(list_data_sets(hdf5, "/", file))),
             "name one of them with --dataset");
}

/// In the child.
std::string describe_here(const ByteSource& bytes, const std::string& wanted) {
  Hdf5Source source{.bytes = &bytes, .noted = {}};
  const Hdf5Handle hdf5 = open_file(source, bytes.name());
  const std::string path = find_data_set(hdf5.get(), wanted, bytes.name());
  return pack(describe_data_set(source, hdf5.get(), path));
}

class Checker {
 public:
  Checker(const ByteSource& source, const Hdf5Description& description)
      : source_(source), description_(description) {}

  void check() const {
    demand(!description_.path.empty() && !description_.shape.empty(), "it has no name or shape");
    if (description_.layout == Hdf5Layout::kContiguous) check_run();
    if (description_.layout == Hdf5Layout::kCompact) {
      demand(description_.bytes.size() == voxel_bytes(), "it is not as long as its shape needs");
    }
    if (description_.layout == Hdf5Layout::kChunked) check_chunks();
  }

 private:
  void check_run() const {
    const std::uint64_t size = source_.size();
    const std::uint64_t held = description_.offset < size ? size - description_.offset : 0;
    if (voxel_bytes() <= held) return;
    fail_input(
        source_.name(), text("data set ", description_.path),
        text("shape ", shape_text(description_.shape), " of ", name(description_.type), " needs ",
             voxel_bytes(), " bytes after offset ", description_.offset, ", the file holds ", held),
        kCheckFile);
  }

  void check_chunks() const {
    demand(description_.chunk_shape.size() == description_.shape.size(),
           "its chunks have other axes");
    for (const std::uint64_t extent : description_.chunk_shape) {
      demand(extent > 0, "a chunk is empty");
    }
    demand(description_.fill.size() == static_cast<std::size_t>(byte_size(description_.type)),
           "its fill value is no voxel");
    const std::uint64_t size = source_.size();
    std::uint64_t all = 0, next = 0;
    for (const Hdf5Chunk& chunk : description_.chunks) {
      demand(chunk.number >= next, "its chunks are out of order");
      demand(chunk.offset <= size && chunk.bytes <= size - chunk.offset,
             "a chunk is outside of the file");
      next = chunk.number + 1;
      all += chunk.bytes;
    }
    // Many chunks in one place would make little bytes a large volume.
    demand(all <= size, "its chunks overlap");
  }

  /// The most that 64 bits hold when it is more.
  [[nodiscard]] std::uint64_t voxel_bytes() const {
    auto bytes = static_cast<std::uint64_t>(byte_size(description_.type));
    for (const std::uint64_t extent : description_.shape) {
      if (__builtin_mul_overflow(bytes, extent, &bytes)) return UINT64_MAX;
    }
    return bytes;
  }

  void demand(bool met, const char* otherwise) const {
    if (met) return;
    fail_input(source_.name(), text("data set ", description_.path), otherwise, kCheckFile);
  }

  const ByteSource& source_;
  const Hdf5Description& description_;
};

}  // namespace

Hdf5Description describe_hdf5(const ByteSource& source, const std::string& data_set) {
  // A chunk takes at least a byte of the file.
  const std::uint64_t max_chunks = std::min<std::uint64_t>(kMaxHdf5Chunks, source.size());
  ApartLimits limits;
  limits.answer_bytes = kMaxPackedDescription + sizeof(Hdf5Chunk) * max_chunks;
  const ApartAnswer answer = run_apart(limits, [&] { return describe_here(source, data_set); });
  if (!answer.bytes) {
    fail_input(source.name(), "HDF5 structure",
               text("the HDF5 library could not read it: ", answer.death), kCheckFile);
  }
  std::optional<Hdf5Description> description = unpack_description(*answer.bytes);
  if (!description) {
    fail_input(source.name(), "HDF5 structure",
               "the HDF5 library could not read it: its answer is broken", kCheckFile);
  }
  check_description(source, *description);
  return std::move(*description);
}

void check_description(const ByteSource& source, const Hdf5Description& description) {
  Checker(source, description).check();
}

}  // namespace mw::io
