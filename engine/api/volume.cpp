// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of the library.
#include "engine/api/array_volume.h"
#include "engine/api/guarded.h"
#include "engine/api/spaces.h"
#include "engine/api/volume_access.h"
#include "io/names/read_names.h"
#include "io/volume/file_space.h"
#include "io/volume/open_volume.h"
#include "kernels/synth/synth.h"

namespace mwmesh {
namespace {

namespace io = mw::io;

io::FrameChoice frame_choice(const std::string& name) {
  if (const auto choice = io::parse_frame_choice(name)) return *choice;
  throw mw::Error(mw::ErrorKind::kUsage, "frame " + name + ": expected file, ras, lps or voxel");
}

/// A volume of which somebody else may hold a part.
class SharedVolume : public io::LabelVolume {
 public:
  SharedVolume(std::shared_ptr<const io::LabelVolume> volume) : volume_(std::move(volume)) {}

  [[nodiscard]] const io::VolumeInfo& info() const override { return volume_->info(); }
  void read(const mw::Box3& box, std::span<mw::RawLabel> out) const override {
    volume_->read(box, out);
  }
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override {
    return volume_->buffer_bytes(threads);
  }
  void drop_buffers() const override { volume_->drop_buffers(); }

 private:
  std::shared_ptr<const io::LabelVolume> volume_;
};

}  // namespace

Volume Volume::of(const ArrayVolume& array) {
  return mw::api::guarded(
      [&] { return VolumeAccess::wrap(std::make_shared<mw::api::ArrayReader>(array)); });
}

Volume Volume::of(const RegionVolume& region) {
  return mw::api::guarded(
      [&] { return VolumeAccess::wrap(std::make_shared<mw::api::RegionReader>(region)); });
}

Volume Volume::open(const VolumeFile& file) {
  return mw::api::guarded([&] {
    io::OpenOptions options{.spacing = file.spacing,
                            .origin = file.origin,
                            .frame = frame_choice(file.frame),
                            .dataset = file.dataset,
                            .scale = file.scale};
    if (file.crop) options.crop = mw::api::io_box(*file.crop);
    return VolumeAccess::wrap(io::open_volume(file.path, options));
  });
}

Volume Volume::with_names(const std::vector<LabelName>& names) const {
  return mw::api::guarded([&] {
    return VolumeAccess::wrap(std::make_shared<io::NamedVolume>(
        std::make_unique<SharedVolume>(VolumeAccess::shared(*this)), mw::api::io_names(names)));
  });
}

Index Volume::shape() const {
  const mw::Index3 shape = VolumeAccess::labels(*this).info().shape;
  return {shape.x, shape.y, shape.z};
}

VoxelType Volume::type() const {
  return static_cast<VoxelType>(VolumeAccess::labels(*this).info().type);
}

Space Volume::space() const {
  return mw::api::library_space(VolumeAccess::labels(*this).info().space);
}

bool Volume::labels_are_signed() const {
  return io::has_signed_labels(VolumeAccess::labels(*this).info());
}

std::vector<LabelName> Volume::names() const {
  return mw::api::library_names(VolumeAccess::labels(*this).info().names);
}

void Volume::read(const Box& box, std::span<std::uint64_t> out) const {
  mw::api::guarded([&] { VolumeAccess::labels(*this).read(mw::api::io_box(box), out); });
}

std::vector<std::uint64_t> synth(std::string_view kind, const Index& shape, std::uint64_t labels,
                                 std::uint64_t seed) {
  return mw::api::guarded([&] {
    const std::optional<mw::SynthKind> found = mw::parse_synth_kind(kind);
    if (!found) {
      throw mw::Error(mw::ErrorKind::kUsage,
                      "kind " + std::string(kind) +
                          ": expected voronoi, tubes, spheres, noise or checkerboard");
    }
    const mw::SynthSpec spec{
        .kind = *found, .shape = {shape[0], shape[1], shape[2]}, .labels = labels, .seed = seed};
    mw::check_synth_spec(spec);
    std::vector<std::uint64_t> out(static_cast<std::size_t>(spec.shape.product()));
    mw::synth_slab(spec, 0, spec.shape.z, out);
    return out;
  });
}

}  // namespace mwmesh
