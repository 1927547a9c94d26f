// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a labelled volume of any format that is read here.
#include "io/volume/open_volume.h"

#include <cmath>

#include "io/file/errors.h"
#include "io/file/file_source.h"
#include "io/file/open_bytes.h"
#include "io/volume/checks.h"
#include "io/volume/nifti/nifti_header.h"
#include "io/volume/nifti/open_nifti.h"
#include "io/volume/npy/npy_header.h"
#include "io/volume/npy/open_npy.h"
#include "io/volume/nrrd/nrrd_header.h"
#include "io/volume/nrrd/open_nrrd.h"
#include "io/volume/raw/open_raw.h"

namespace mw::io {
namespace {

enum class Format { kUnknown, kNpy, kNifti, kNrrd };

Format format_of_content(std::span<const std::byte> head) {
  if (has_npy_magic(head)) return Format::kNpy;
  if (has_nrrd_magic({reinterpret_cast<const char*>(head.data()), head.size()})) {
    return Format::kNrrd;
  }
  if (has_nifti_magic(head)) return Format::kNifti;
  return Format::kUnknown;
}

/// For files whose content says nothing, so that the right reader explains what is wrong.
Format format_of_name(std::filesystem::path path) {
  if (path.extension() == ".gz") path = path.stem();
  const std::string extension = path.extension().string();
  if (extension == ".npy") return Format::kNpy;
  if (extension == ".nii") return Format::kNifti;
  if (extension == ".nrrd" || extension == ".nhdr") return Format::kNrrd;
  return Format::kUnknown;
}

void check_options(const OpenOptions& options) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (options.spacing && !(std::isfinite((*options.spacing)[i]) && (*options.spacing)[i] > 0)) {
      throw Error(ErrorKind::kUsage, "--spacing: not three finite positive numbers");
    }
    if (options.origin && !std::isfinite((*options.origin)[i])) {
      throw Error(ErrorKind::kUsage, "--origin: not three finite numbers");
    }
  }
}

/// A raw file of the right size may begin with gzip's magic by chance: it is then not inflated.
std::unique_ptr<ByteSource> open_raw_bytes(const std::filesystem::path& path,
                                           const RawLayout& layout) {
  auto plain = std::make_unique<FileSource>(path);
  const Index3 shape =
      checked_shape(plain->name(), "shape", {layout.shape.x, layout.shape.y, layout.shape.z});
  const VolumeInfo info{.shape = shape, .type = layout.type, .format = "raw"};
  if (plain->size() == payload_bytes(info)) return plain;
  return open_bytes(path);
}

}  // namespace

std::unique_ptr<LabelVolume> open_volume(const std::filesystem::path& path,
                                         const OpenOptions& options) {
  check_options(options);
  if (options.raw) return open_raw(open_raw_bytes(path, *options.raw), options);
  std::unique_ptr<ByteSource> source = open_bytes(path);
  Format format = format_of_content(read_prefix(*source, kNiftiHeaderBytes));
  if (format == Format::kUnknown) format = format_of_name(path);
  switch (format) {
    case Format::kNpy:
      return open_npy(std::move(source), options);
    case Format::kNifti:
      return open_nifti(std::move(source), options);
    case Format::kNrrd:
      return open_nrrd(std::move(source), path, options);
    case Format::kUnknown:
      break;
  }
  fail_input(path.string(), "format", "unknown by content and by extension",
             "supported are .npy, .nii, .nrrd and .nhdr, each also as .gz, and raw files with "
             "--shape and --dtype");
}

}  // namespace mw::io
