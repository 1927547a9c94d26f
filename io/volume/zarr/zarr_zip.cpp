// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a Zarr store in a ZIP archive.
#include "io/file/errors.h"
#include "io/store/zip_store.h"
#include "io/volume/zarr/open_zarr.h"

namespace mw::io {
namespace {

/// Returns the place of the store in the archive.
Place store_of(std::unique_ptr<ByteSource> archive) {
  const Place top = zip_place(std::move(archive));
  if (is_zarr_node(top)) return top;
  const std::vector<std::string> folders = *top.folders();
  std::vector<Place> stores;
  for (const std::string& folder : folders) {
    if (is_zarr_node(top / folder)) stores.push_back(top / folder);
  }
  if (stores.size() == 1) return stores.front();
  fail_input(top.string(), {},
             stores.empty() ? "the archive holds no Zarr (zarr.json, .zarray, .zgroup)"
                            : "the archive holds several Zarr stores",
             "zip the content of one .zarr folder; unpack other archives first");
}

}  // namespace

std::unique_ptr<LabelVolume> open_zarr_zip(std::unique_ptr<ByteSource> archive,
                                           const OpenOptions& options) {
  return open_zarr(store_of(std::move(archive)), options);
}

std::size_t count_zarr_zip_scales(std::unique_ptr<ByteSource> archive, const OpenOptions& options) {
  return count_zarr_scales(store_of(std::move(archive)), options);
}

}  // namespace mw::io
