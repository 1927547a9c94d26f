// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a .npy file piece by piece.
#include "io/volume/npy/open_npy.h"

#include <algorithm>
#include <vector>

#include "io/file/errors.h"
#include "io/volume/decode.h"

namespace mw::io {
namespace {

constexpr std::size_t kChunkVoxels = 1 << 16;

}  // namespace

NpyWriter::NpyWriter(const std::filesystem::path& path, const VolumeInfo& info)
    : file_(path),
      name_(path.string()),
      type_(info.type),
      expected_(static_cast<std::uint64_t>(info.shape.product())) {
  file_.append(format_npy_header(info));
}

void NpyWriter::write(std::span<const RawLabel> labels) {
  const auto size = static_cast<std::size_t>(byte_size(type_));
  std::vector<std::byte> bytes(std::min(labels.size(), kChunkVoxels) * size);
  while (!labels.empty()) {
    const auto chunk = labels.first(std::min(labels.size(), kChunkVoxels));
    const std::size_t held = encode_voxels(chunk, type_, bytes);
    if (held < chunk.size()) {
      fail_usage(name_, ": label ", chunk[held], " does not fit into ", name(type_),
                 "; choose a wider voxel type");
    }
    file_.append(std::span(bytes).first(chunk.size() * size));
    written_ += chunk.size();
    labels = labels.subspan(chunk.size());
  }
}

void NpyWriter::finish() {
  if (written_ != expected_) {
    fail_usage(name_, ": ", written_, " voxels written, the shape has ", expected_);
  }
  file_.commit();
}

}  // namespace mw::io
