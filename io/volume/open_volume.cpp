// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a labelled volume of any format that is read here.
#include "io/volume/open_volume.h"

#include <array>
#include <cmath>

#include "io/file/errors.h"
#include "io/file/file_source.h"
#include "io/file/open_bytes.h"
#include "io/volume/checks.h"
#include "io/volume/cropped_volume.h"
#include "io/volume/hdf5/open_hdf5.h"
#include "io/volume/metaimage/metaimage_header.h"
#include "io/volume/metaimage/open_metaimage.h"
#include "io/volume/n5/open_n5.h"
#include "io/volume/nifti/nifti_header.h"
#include "io/volume/nifti/open_nifti.h"
#include "io/volume/npy/npy_header.h"
#include "io/volume/npy/open_npy.h"
#include "io/volume/nrrd/nrrd_header.h"
#include "io/volume/nrrd/open_nrrd.h"
#include "io/volume/png/open_png.h"
#include "io/volume/png/png_file.h"
#include "io/volume/precomputed/open_precomputed.h"
#include "io/volume/raw/open_raw.h"
#include "io/volume/slices/slice_folder.h"
#include "io/volume/tiff/open_tiff.h"
#include "io/volume/zarr/open_zarr.h"

namespace mw::io {
namespace {

/// A format of one file.
struct FileFormat {
  const char* extensions;  ///< each with a dot, a blank between two; also in front of .gz
  bool (*has_magic)(std::span<const std::byte> head);
  std::unique_ptr<LabelVolume> (*open)(std::unique_ptr<ByteSource> source,
                                       const std::filesystem::path& path,
                                       const OpenOptions& options);
};

bool has_nrrd_text(std::span<const std::byte> head) {
  return has_nrrd_magic({reinterpret_cast<const char*>(head.data()), head.size()});
}

constexpr std::array kFileFormats{
    FileFormat{".npy", has_npy_magic,
               [](auto source, const auto&, const auto& options) {
                 return open_npy(std::move(source), options);
               }},
    FileFormat{".nrrd .nhdr", has_nrrd_text, open_nrrd},
    FileFormat{".h5 .hdf5 .hdf .he5 .h5ad .dream3d", has_hdf5_magic,
               [](auto source, const auto&, const auto& options) {
                 return open_hdf5(std::move(source), options);
               }},
    FileFormat{".mha .mhd", has_metaimage_magic, open_metaimage},
    FileFormat{".tif .tiff", has_tiff_magic,
               [](auto source, const auto&, const auto& options) {
                 return open_tiff(std::move(source), options);
               }},
    FileFormat{".png", has_png_magic,
               [](auto, const auto& path, const auto& options) {
                 return open_png_slices({path}, options);
               }},
    FileFormat{".nii", has_nifti_magic,
               [](auto source, const auto&, const auto& options) {
                 return open_nifti(std::move(source), options);
               }},
};

/// A format of a folder.
struct FolderFormat {
  bool (*is_one)(const std::filesystem::path& folder);
  std::unique_ptr<LabelVolume> (*open)(const std::filesystem::path& folder,
                                       const OpenOptions& options);
};

/// Slices come last: other stores may hold pictures too.
constexpr std::array kFolderFormats{
    FolderFormat{is_precomputed, open_precomputed},
    FolderFormat{is_n5, open_n5},
    FolderFormat{is_zarr, open_zarr},
    FolderFormat{is_slice_folder, open_slice_folder},
};

/// By content, else by extension, so that the right reader explains what is wrong.
const FileFormat* format_of(std::span<const std::byte> head, std::filesystem::path path) {
  for (const FileFormat& format : kFileFormats) {
    if (format.has_magic(head)) return &format;
  }
  if (path.extension() == ".gz") path = path.stem();
  const std::string extension = path.extension().string();
  for (const FileFormat& format : kFileFormats) {
    if (extension.empty()) break;
    const std::string all = std::string(format.extensions) + " ";
    if (all.find(extension + " ") != std::string::npos) return &format;
  }
  return nullptr;
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

std::unique_ptr<LabelVolume> open_folder(const std::filesystem::path& path,
                                         const OpenOptions& options) {
  for (const FolderFormat& format : kFolderFormats) {
    if (format.is_one(path)) return format.open(path, options);
  }
  fail_input(path.string(), "format", "the folder is no volume that is known here",
             "give a file in it");
}

std::unique_ptr<LabelVolume> open_whole(const std::filesystem::path& path,
                                        const OpenOptions& options) {
  if (options.raw) return open_raw(open_raw_bytes(path, *options.raw), options);
  if (std::filesystem::is_directory(path)) return open_folder(path, options);
  std::unique_ptr<ByteSource> source = open_bytes(path);
  const FileFormat* format = format_of(read_prefix(*source, kNiftiHeaderBytes), path);
  if (format != nullptr) return format->open(std::move(source), path, options);
  fail_input(path.string(), "format", "unknown by content and by extension",
             "supported are .npy, .npz, .nii, .nrrd, .nhdr, .mha, .mhd, .h5, .tif, .png, "
             "most of them also as .gz, raw files with --shape and --dtype, and folders: "
             "Zarr, N5, neuroglancer precomputed, slices");
}

}  // namespace

std::unique_ptr<LabelVolume> open_volume(const std::filesystem::path& path,
                                         const OpenOptions& options) {
  check_options(options);
  return cropped(open_whole(path, options), path.string(), options);
}

}  // namespace mw::io
