// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes: files of each format, and metadata and chunks of stores.
#include "io/file/source/inflated_source.h"
#include "io/volume/freesurfer/open_mgh.h"
#include "io/volume/metaimage/open_metaimage.h"
#include "io/volume/n5/open_n5.h"
#include "io/volume/nifti/open_nifti.h"
#include "io/volume/npy/open_npy.h"
#include "io/volume/nrrd/open_nrrd.h"
#include "io/volume/png/open_png.h"
#include "io/volume/precomputed/open_precomputed.h"
#include "io/volume/raw_array.h"
#include "io/volume/tiff/open_tiff.h"
#include "io/volume/vti/open_vti.h"
#include "io/volume/zarr/open_zarr.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/byte_file.h"
#include "tests/fuzz/choices.h"
#include "tests/fuzz/file_tree.h"
#include "tests/fuzz/look_at_volume.h"

namespace mw::fuzz {
namespace {

using Opened = std::unique_ptr<io::LabelVolume>;
using OpenFile = Opened (*)(std::unique_ptr<io::ByteSource>, const io::OpenOptions&);
using OpenStore = Opened (*)(const io::Place&, const io::OpenOptions&);

/// Named, as GCC 12 with precompiled headers cannot make one of `{}` within a template.
const io::OpenOptions kPlain;

template <OpenFile open>
void file(Bytes bytes) {
  ends_well([&] { look_at(*open(std::make_unique<ByteFile>(bytes), kPlain)); });
}

template <OpenStore open>
void folder(Bytes bytes) {
  const FileTree files(bytes);
  ends_well([&] { look_at(*open(files.path(), {.cache_bytes = 1 << 20})); });
}

/// A header a.hdr and voxels a.img.
void nifti_pair(Bytes bytes) {
  const FileTree files(bytes);
  ends_well([&] { look_at(*io::open_nifti(io::open_bytes(files.path() / "a.hdr"), kPlain)); });
  ends_well([&] { look_at(*io::open_nifti(io::open_bytes(files.path() / "a.img"), kPlain)); });
}

/// The reader opens files itself.
void png(Bytes bytes) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "slice.png";
  std::ofstream(path, std::ios::binary) << text_of(bytes);
  ends_well([&] { look_at(*io::open_png_slices({path}, {})); });
}

/// The first bytes are what the caller says of the file.
void raw(Bytes bytes) {
  Choices choices(bytes);
  io::RawLayout layout;
  const auto edge = [&] { return static_cast<std::int64_t>(choices.below(20)) - 1; };
  layout.shape.x = edge();
  layout.shape.y = edge();
  layout.shape.z = edge();
  layout.type = static_cast<io::VoxelType>(choices.below(10));
  layout.order = choices.below(2) == 0 ? io::ByteOrder::kLittle : io::ByteOrder::kBig;
  const Bytes voxels = choices.rest();
  ends_well([&] { look_at(*io::open_raw(std::make_unique<ByteFile>(voxels), {.raw = layout})); });
}

/// What comes out has a size that deflate can reach, and can be read.
void gzip(Bytes bytes) {
  ends_well([&] {
    auto packed = std::make_unique<ByteFile>(bytes);
    if (!io::is_gzip(*packed)) return;
    const io::InflatedSource plain(std::move(packed), 0);
    static_cast<void>(io::read_prefix(plain, 64));
    require(plain.size() <= 1032 * bytes.size(), "deflate packs no tighter than 1 to 1032");
  });
}

}  // namespace

std::vector<Target> volume_targets() {
  return {{"npy", file<io::open_npy>},
          {"nrrd", file<io::open_nrrd>},
          {"nifti", file<io::open_nifti>},
          {"nifti_pair", nifti_pair},
          {"mgh", file<io::open_mgh>},
          {"metaimage", file<io::open_metaimage>},
          {"tiff", file<io::open_tiff>},
          {"vti", file<io::open_vti>},
          {"png", png},
          {"raw", raw},
          {"gzip", gzip},
          {"zarr", folder<io::open_zarr>},
          {"zarr_zip", file<io::open_zarr_zip>},
          {"n5", folder<io::open_n5>},
          {"precomputed", folder<io::open_precomputed>}};
}

}  // namespace mw::fuzz
