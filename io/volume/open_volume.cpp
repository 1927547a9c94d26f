// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a labelled volume of any format that is read here.
#include "io/volume/open_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "io/file/errors.h"
#include "io/file/folder.h"
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/file/text_numbers.h"
#include "io/remote/address.h"
#include "io/remote/remote_store.h"
#include "io/store/place.h"
#include "io/store/zip_directory.h"
#include "io/volume/checks.h"
#include "io/volume/cropped_volume.h"
#include "io/volume/dicom/open_dicom.h"
#include "io/volume/freesurfer/open_mgh.h"
#include "io/volume/hdf5/open_hdf5.h"
#include "io/volume/masks/open_masks.h"
#include "io/volume/metaimage/open_metaimage.h"
#include "io/volume/n5/open_n5.h"
#include "io/volume/nifti/open_nifti.h"
#include "io/volume/npy/open_npy.h"
#include "io/volume/nrrd/open_nrrd.h"
#include "io/volume/object/open_object.h"
#include "io/volume/png/open_png.h"
#include "io/volume/precomputed/open_precomputed.h"
#include "io/volume/raw_array.h"
#include "io/volume/scores/open_scores.h"
#include "io/volume/slices/slice_folder.h"
#include "io/volume/tiff/open_tiff.h"
#include "io/volume/vti/open_vti.h"
#include "io/volume/zarr/open_zarr.h"

namespace mw::io {
namespace {

using OpenFile = std::unique_ptr<LabelVolume> (*)(std::unique_ptr<ByteSource> source,
                                                  const OpenOptions& options);
using OpenFolder = std::unique_ptr<LabelVolume> (*)(const std::filesystem::path& folder,
                                                    const OpenOptions& options);
using OpenStore = std::unique_ptr<LabelVolume> (*)(const Place& place, const OpenOptions& options);

/// One format: what it is called, how it is told, how it is read, and which options it understands.
struct VolumeFormat {
  const char* name;  ///< in help and errors
  /// Endings of a file, each with a dot, with blanks between them; .gz may follow them.  Null in
  /// rows of folders and stores, as are the next two.
  const char* endings = nullptr;
  bool (*is_file)(std::span<const std::byte> head) = nullptr;
  OpenFile open_file = nullptr;
  /// Null in rows of files and stores.
  bool (*is_folder)(const std::filesystem::path& folder) = nullptr;
  OpenFolder open_folder = nullptr;
  /// Null in rows of files and other folders.  A store is a folder, or an address of a server.
  bool (*is_store)(const Place& place) = nullptr;
  OpenStore open_store = nullptr;
  bool has_datasets = false;  ///< --dataset chooses in it
  bool has_scales = false;    ///< --scale chooses in it
  bool has_masks = false;     ///< --overlap says what masks become that overlap
  bool has_forms = false;     ///< --use-form chooses one of two places
  /// Null where the format has no scales; the first in rows of stores, the second in those of
  /// files.
  std::size_t (*count_scales)(const Place& place, const OpenOptions& options) = nullptr;
  std::size_t (*count_file_scales)(std::unique_ptr<ByteSource> source,
                                   const OpenOptions& options) = nullptr;
};

/// Folders of slices come last: other stores may hold pictures, too.
constexpr std::array kFormats{
    VolumeFormat{"NumPy", ".npy", has_npy_magic, open_npy},
    VolumeFormat{.name = "NRRD",
                 .endings = ".nrrd .nhdr",
                 .is_file = has_nrrd_magic,
                 .open_file = open_nrrd,
                 .has_masks = true},
    VolumeFormat{.name = "HDF5",
                 .endings = ".h5 .hdf5 .he5 .h5ad .dream3d",
                 .is_file = has_hdf5_magic,
                 .open_file = open_hdf5,
                 .has_datasets = true},
    VolumeFormat{"MetaImage", ".mha .mhd", has_metaimage_magic, open_metaimage},
    VolumeFormat{.name = "VTK image",
                 .endings = ".vti",
                 .is_file = has_vti_magic,
                 .open_file = open_vti,
                 .has_datasets = true},
    VolumeFormat{"TIFF", ".tif .tiff", has_tiff_magic, open_tiff},
    VolumeFormat{"PNG", ".png", has_png_magic, open_png},
    VolumeFormat{.name = "NIfTI",
                 .endings = ".nii .hdr .img",
                 .is_file = has_nifti_magic,
                 .open_file = open_nifti,
                 .has_masks = true,
                 .has_forms = true},
    VolumeFormat{.name = "FreeSurfer",
                 .endings = ".mgh .mgz",
                 .is_file = has_mgh_magic,
                 .open_file = open_mgh,
                 .has_masks = true},
    VolumeFormat{.name = "DICOM segmentation",
                 .endings = ".dcm",
                 .is_file = has_dicom_magic,
                 .open_file = open_dicom,
                 .has_masks = true},
    VolumeFormat{.name = "zipped Zarr",
                 .endings = ".zip",
                 .is_file = has_zip_magic,
                 .open_file = open_zarr_zip,
                 .has_datasets = true,
                 .has_scales = true,
                 .count_file_scales = count_zarr_zip_scales},
    VolumeFormat{.name = "neuroglancer precomputed",
                 .is_store = is_precomputed,
                 .open_store = open_precomputed,
                 .has_datasets = true,
                 .has_scales = true,
                 .count_scales = count_precomputed_scales},
    VolumeFormat{.name = "N5",
                 .is_store = is_n5,
                 .open_store = open_n5,
                 .has_datasets = true,
                 .has_scales = true,
                 .count_scales = count_n5_scales},
    VolumeFormat{.name = "Zarr",
                 .is_store = is_zarr,
                 .open_store = open_zarr,
                 .has_datasets = true,
                 .has_scales = true,
                 .count_scales = count_zarr_scales},
    VolumeFormat{.name = "TIFF or PNG slices",
                 .is_folder = is_slice_folder,
                 .open_folder = open_slice_folder},
    VolumeFormat{.name = "masks",
                 .is_folder = is_mask_folder,
                 .open_folder = open_mask_folder,
                 .has_masks = true,
                 .has_forms = true},
};
/// Masks that are listed instead of being in a folder of their own.
constexpr VolumeFormat kMaskList{.name = "masks", .has_masks = true, .has_forms = true};
/// The format of any content where the caller says how the voxels lie.
constexpr VolumeFormat kRawFormat{.name = "raw"};

/// The names of the formats that are meant, as "A, B, C".
template <class IsMeant>
std::string names_of(IsMeant is_meant) {
  std::string out;
  for (const VolumeFormat& format : kFormats) {
    if (is_meant(format)) out += (out.empty() ? "" : ", ") + text(format.name);
  }
  return out;
}

std::string stores() {
  return names_of([](const VolumeFormat& format) { return format.is_store != nullptr; });
}

bool has_ending(const VolumeFormat& format, const std::string& ending) {
  if (ending.empty() || format.endings == nullptr) return false;
  return text(format.endings, " ").find(ending + " ") != std::string::npos;
}

/// Tells the format by content, else by extension, so that the right reader says what is wrong.
const VolumeFormat& format_of(std::span<const std::byte> head, std::filesystem::path path) {
  for (const VolumeFormat& format : kFormats) {
    if (format.is_file != nullptr && format.is_file(head)) return format;
  }
  const std::string file = path.string();
  if (lower_case(path.extension().string()) == ".gz") path = path.stem();
  for (const VolumeFormat& format : kFormats) {
    if (has_ending(format, lower_case(path.extension().string()))) return format;
  }
  fail_input(file, "format", "unknown by content and by extension",
             text("supported are ", volume_endings(),
                  ", most of them also as .gz, raw files with --shape and --dtype, and folders: ",
                  volume_folders()));
}

/// Whether one of the first files of the folder is DICOM.
bool holds_dicom(const std::filesystem::path& folder) {
  int left = 8;
  std::error_code failed;
  for (const std::string& name : entries_in(folder, failed)) {
    const std::filesystem::path path = folder / name;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) continue;
    if (has_dicom_magic(read_prefix(FileSource(path), kNiftiHeaderBytes))) return true;
    if (--left == 0) return false;
  }
  return false;
}

const VolumeFormat& format_of_folder(const std::filesystem::path& folder) {
  for (const VolumeFormat& format : kFormats) {
    if (format.is_store != nullptr && format.is_store(folder)) return format;
    if (format.is_folder != nullptr && format.is_folder(folder)) return format;
  }
  if (holds_dicom(folder)) {
    fail_input(folder.string(), "format", "a folder of DICOM files is not read",
               "give the file of a DICOM segmentation; images have no labels");
  }
  fail_input(folder.string(), "format", "the folder is no volume that is known here",
             "give a file in it");
}

/// An option that says nothing about this file is a mistake, which is better said than passed over.
void check_understood(const VolumeFormat& format, const std::filesystem::path& path,
                      const OpenOptions& options) {
  const auto fail = [&](const char* option, const char* what, const std::string& others) {
    fail_usage(option, ": ", path.string(), " is ", format.name, ", which has no ", what,
               "; it is for ", others);
  };
  if (!options.dataset.empty() && !format.has_datasets) {
    fail("--dataset", "arrays to choose from", formats_with_datasets());
  }
  if (options.scale && !format.has_scales) fail("--scale", "scales", formats_with_scales());
  if (options.overlap != Overlap::kRefused && !format.has_masks) {
    fail("--overlap", "masks", formats_with_masks());
  }
  if (options.form != FormChoice::kFile && !format.has_forms) {
    fail("--use-form", "sform or qform", "NIfTI");
  }
}

/// The format of what is on a server.
const VolumeFormat& format_of_remote(const Place& place) {
  for (const VolumeFormat& format : kFormats) {
    if (format.is_store != nullptr && format.is_store(place)) return format;
  }
  const std::string refusal = place.refusal();
  if (!refusal.empty()) {
    fail_input(place.string(), "format", "the server shows no metadata of a volume there", refusal);
  }
  fail_input(place.string(), "format", "the server has no metadata of a volume there",
             text("give the address of the folder that holds them; remote volumes are ", stores(),
                  ", and files of other formats are to be copied to a disk first"));
}

const CacheFolder* cache_of(const OpenOptions& options) {
  return options.cache ? &*options.cache : nullptr;
}

std::unique_ptr<LabelVolume> open_remote(const std::string& address, const OpenOptions& options) {
  if (options.raw) {
    fail_usage("--shape: ", address, " is remote, and raw files are read from disks only");
  }
  const Place place = remote_place(address, cache_of(options));
  const VolumeFormat& format = format_of_remote(place);
  check_understood(format, address, options);
  return format.open_store(place, options);
}

/// False for a path that cannot be looked at; opening it as a file says why.
bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

std::unique_ptr<LabelVolume> open_whole(const std::filesystem::path& path,
                                        const OpenOptions& options) {
  if (is_remote_address(path.string())) return open_remote(path.string(), options);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) check_scheme(path.string());
  if (options.raw) {
    check_understood(kRawFormat, path, options);
    return open_raw(open_raw_bytes(path, *options.raw), options);
  }
  if (is_folder(path)) {
    const VolumeFormat& format = format_of_folder(path);
    check_understood(format, path, options);
    return format.open_store != nullptr ? format.open_store(path, options)
                                        : format.open_folder(path, options);
  }
  if (const std::vector<std::filesystem::path> masks = listed_masks(path); !masks.empty()) {
    check_understood(kMaskList, path, options);
    return open_masks(masks, path.string(), options);
  }
  std::unique_ptr<ByteSource> source = open_bytes(path);
  const VolumeFormat& format = format_of(read_prefix(*source, kNiftiHeaderBytes), path);
  check_understood(format, path, options);
  return format.open_file(std::move(source), options);
}

/// Returns how many scales a file has.  Lists of files have none.
std::size_t count_file_scales(const std::filesystem::path& path, const OpenOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return 0;
  std::unique_ptr<ByteSource> source = open_bytes(path);
  const VolumeFormat& format = format_of(read_prefix(*source, kNiftiHeaderBytes), path);
  if (format.count_file_scales == nullptr) return 0;
  return format.count_file_scales(std::move(source), options);
}

std::size_t count_scales(const std::filesystem::path& path, const OpenOptions& options) {
  const bool is_remote = is_remote_address(path.string());
  if (options.raw) return 0;
  if (!is_remote && !is_folder(path)) return count_file_scales(path, options);
  const Place place = is_remote ? remote_place(path.string(), cache_of(options)) : Place(path);
  const VolumeFormat& format = is_remote ? format_of_remote(place) : format_of_folder(path);
  return format.count_scales == nullptr ? 0 : format.count_scales(place, options);
}

/// Opens the object that the options name, in a box around it.
std::unique_ptr<LabelVolume> open_object_of(const std::filesystem::path& path,
                                            const OpenOptions& options) {
  constexpr std::uint64_t kCacheShares = 4;  // a volume keeps a quarter of memory at most
  std::vector<VolumeScale> coarser = scales_of(path, options);
  std::erase_if(
      coarser, [&](const VolumeScale& scale) { return scale.number <= options.scale.value_or(0); });
  ScaledVolume scaled{.name = path.string(),
                      .volume = open_whole(path, options),
                      .copies = static_cast<int>(coarser.size()),
                      .memory = kCacheShares * options.cache_bytes,
                      .at_once = options.at_once};
  scaled.open_copy = [&](int copy) {
    OpenOptions one = options;
    one.scale = coarser[coarser.size() - 1 - static_cast<std::size_t>(copy)].number;
    return open_whole(path, one);
  };
  Box3 bounds{{0, 0, 0}, scaled.volume->info().shape};
  if (options.crop) {
    bounds = voxels_of_crop(path.string(), *options.crop, scaled.volume->info());
  }
  ObjectView view = open_object(std::move(scaled), options.object, bounds);
  return std::make_unique<CroppedVolume>(std::move(view.volume), view.box, !options.origin);
}

}  // namespace

std::string volume_endings() {
  std::string out;
  for (const VolumeFormat& format : kFormats) {
    if (format.endings != nullptr) out += (out.empty() ? "" : " ") + text(format.endings);
  }
  for (std::size_t at = 0; (at = out.find(' ', at)) != std::string::npos; at += 2) {
    out.insert(at, ",");
  }
  return out;
}

std::string volume_folders() {
  return names_of([](const VolumeFormat& format) { return format.endings == nullptr; });
}

std::string formats_with_datasets() {
  return names_of([](const VolumeFormat& format) { return format.has_datasets; });
}

std::string formats_with_scales() {
  return names_of([](const VolumeFormat& format) { return format.has_scales; });
}

std::string formats_with_masks() {
  return names_of([](const VolumeFormat& format) { return format.has_masks; });
}

void check_place(const std::optional<Vector3>& spacing, const std::optional<Vector3>& origin) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  const auto is_length = [](double x) { return std::isfinite(x) && x > 0; };
  if (spacing && !std::ranges::all_of(*spacing, is_length)) {
    fail_usage("--spacing: must be finite and positive");
  }
  if (origin && !std::ranges::all_of(*origin, is_finite)) {
    fail_usage("--origin: must be finite");
  }
}

std::vector<VolumeScale> scales_of(const std::filesystem::path& path, const OpenOptions& options) {
  std::vector<VolumeScale> out;
  const std::size_t count = count_scales(path, options);
  OpenOptions one = options;
  one.crop.reset();
  for (std::size_t i = 0; i < count; ++i) {
    one.scale = static_cast<int>(i);
    try {
      out.push_back({*one.scale, open_whole(path, one)->info()});
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kResource) throw;
    }
  }
  return out;
}

std::unique_ptr<LabelVolume> open_volume(const std::filesystem::path& path,
                                         const OpenOptions& options) {
  check_place(options.spacing, options.origin);
  const bool has_scores = options.values != VoxelValues::kLabels;
  if (has_scores && !options.object.empty()) {
    fail_usage("--object: is for volumes of labels, not for --values");
  }
  if (!options.object.empty()) return open_object_of(path, options);
  if (!has_scores) return cropped(open_whole(path, options), path.string(), options);
  const auto open = [](const std::filesystem::path& file, const OpenOptions& of_file) {
    return open_whole(file, of_file);
  };
  return cropped(open_scores(path, options, open), path.string(), options);
}

}  // namespace mw::io
