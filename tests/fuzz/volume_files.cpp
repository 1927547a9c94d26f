// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes in one file.
#include "io/file/source/inflated_source.h"
#include "io/volume/metaimage/open_metaimage.h"
#include "io/volume/nifti/open_nifti.h"
#include "io/volume/npy/open_npy.h"
#include "io/volume/nrrd/open_nrrd.h"
#include "io/volume/png/open_png.h"
#include "io/volume/raw/open_raw.h"
#include "io/volume/tiff/open_tiff.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/byte_file.h"
#include "tests/fuzz/choices.h"
#include "tests/fuzz/file_tree.h"
#include "tests/fuzz/look_at_volume.h"

namespace mw::fuzz {
namespace {

using OpenSource = std::unique_ptr<io::LabelVolume> (*)(std::unique_ptr<io::ByteSource> source,
                                                        const io::OpenOptions& options);
void open_and_look(OpenSource open, Bytes bytes, const io::OpenOptions& options = {}) {
  ends_well([&] { look_at(*open(std::make_unique<ByteFile>(bytes), options)); });
}

}  // namespace

void fuzz_npy(Bytes bytes) {
  open_and_look(io::open_npy, bytes);
}

void fuzz_nrrd(Bytes bytes) {
  open_and_look(io::open_nrrd, bytes);
}

void fuzz_nifti(Bytes bytes) {
  open_and_look(io::open_nifti, bytes);
}

void fuzz_metaimage(Bytes bytes) {
  open_and_look(io::open_metaimage, bytes);
}

void fuzz_tiff(Bytes bytes) {
  open_and_look(io::open_tiff, bytes);
}

/// The reader opens files itself.
void fuzz_png(Bytes bytes) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "slice.png";
  std::ofstream(path, std::ios::binary) << text_of(bytes);
  ends_well([&] { look_at(*io::open_png_slices({path}, {})); });
}

/// The first bytes are what the caller says of the file.
void fuzz_raw(Bytes bytes) {
  Choices choices(bytes);
  io::RawLayout layout;
  const auto edge = [&] { return static_cast<std::int64_t>(choices.below(20)) - 1; };
  layout.shape.x = edge();
  layout.shape.y = edge();
  layout.shape.z = edge();
  layout.type = static_cast<io::VoxelType>(choices.below(10));
  layout.order = choices.below(2) == 0 ? io::ByteOrder::kLittle : io::ByteOrder::kBig;
  open_and_look(io::open_raw, choices.rest(), {.raw = layout});
}

/// What comes out has a size that deflate can reach, and can be read.
void fuzz_gzip(Bytes bytes) {
  ends_well([&] {
    auto packed = std::make_unique<ByteFile>(bytes);
    if (!io::is_gzip(*packed)) return;
    const io::InflatedSource plain(std::move(packed), 0);
    static_cast<void>(io::read_prefix(plain, 64));
    require(plain.size() <= 1032 * bytes.size(), "deflate packs no tighter than 1 to 1032");
  });
}

}  // namespace mw::fuzz
