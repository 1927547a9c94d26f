// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The two files of a NIfTI volume whose voxels are apart from its header.
#include <array>
#include <filesystem>

#include "io/file/errors.h"
#include "io/file/source/inflated_source.h"
#include "io/file/text_numbers.h"
#include "io/volume/nifti/open_nifti.h"

namespace mw::io {
namespace {

namespace fs = std::filesystem;

/// Returns the path without ".gz".
fs::path unpacked_name(const fs::path& path) {
  return lower_case(path.extension().string()) == ".gz" ? fs::path(path).replace_extension() : path;
}

/// Returns the file of the same name with another ending, in either case, gzipped or not; an empty
/// path where there is none.
fs::path beside(const fs::path& path, std::array<const char*, 2> endings) {
  for (const char* ending : endings) {
    for (const char* packed : {"", ".gz", ".GZ"}) {
      fs::path other = unpacked_name(path).replace_extension(text(ending, packed));
      std::error_code ignored;
      if (fs::is_regular_file(other, ignored)) return other;
    }
  }
  return {};
}

}  // namespace

NiftiFiles nifti_files(std::unique_ptr<ByteSource> source) {
  const fs::path path = source->name();
  const bool is_image = lower_case(unpacked_name(path).extension().string()) == ".img" &&
                        !has_nifti_magic(read_prefix(*source, kNiftiHeaderBytes));
  if (!is_image) return {.header = std::move(source), .image = nullptr};
  const fs::path header = beside(path, {".hdr", ".HDR"});
  if (header.empty()) {
    fail_input(path.string(), {}, "has no header beside it, a .hdr of the same name",
               "get the .hdr, too, or say how the voxels lie with --shape and --dtype");
  }
  return {.header = open_bytes(header), .image = std::move(source)};
}

std::unique_ptr<ByteSource> open_nifti_image(const std::string& header) {
  const fs::path image = beside(header, {".img", ".IMG"});
  if (!image.empty()) return open_bytes(image);
  fail_input(header, "magic",
             "the voxels are in another file, and no .img of the same name is there",
             "get the .img, too");
}

}  // namespace mw::io
