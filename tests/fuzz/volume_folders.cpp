// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes in folders: metadata and chunks of stores.
#include "io/volume/n5/open_n5.h"
#include "io/volume/precomputed/open_precomputed.h"
#include "io/volume/zarr/open_zarr.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/file_tree.h"
#include "tests/fuzz/look_at_volume.h"

namespace mw::fuzz {
namespace {

using OpenFolder = std::unique_ptr<io::LabelVolume> (*)(const std::filesystem::path& folder,
                                                        const io::OpenOptions& options);

void open_and_look(OpenFolder open, Bytes bytes) {
  const FileTree files(bytes);
  io::OpenOptions options;
  options.cache_bytes = 1 << 20;
  ends_well([&] { look_at(*open(files.path(), options)); });
}

}  // namespace

void fuzz_zarr(Bytes bytes) {
  open_and_look(io::open_zarr, bytes);
}

void fuzz_n5(Bytes bytes) {
  open_and_look(io::open_n5, bytes);
}

void fuzz_precomputed(Bytes bytes) {
  open_and_look(io::open_precomputed, bytes);
}

}  // namespace mw::fuzz
