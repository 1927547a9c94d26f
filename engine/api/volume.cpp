// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of the library.
#include "engine/api/array_volume.h"
#include "engine/api/guarded.h"
#include "engine/api/jobs.h"
#include "engine/api/types.h"
#include "engine/settings/named_labels.h"
#include "engine/settings/number_text.h"
#include "engine/system/crew.h"
#include "io/names/read_names.h"
#include "io/remote/wait_stop.h"
#include "io/volume/checks.h"
#include "io/volume/named_volume.h"
#include "io/volume/open_volume.h"
#include "kernels/synth/synth.h"

namespace mwmesh {
namespace {

namespace io = mw::io;

io::Overlap overlap_rule(const std::string& name) {
  if (name.empty()) return io::Overlap::kRefused;
  if (const auto rule = io::parse_overlap(name)) return *rule;
  throw mw::Error(mw::ErrorKind::kUsage, "overlap: '" + name + "' is none of first, last and all");
}

io::VoxelValues voxel_values(const std::string& name) {
  if (const auto values = io::parse_voxel_values(name)) return *values;
  throw mw::Error(mw::ErrorKind::kUsage,
                  "values: '" + name + "' is none of labels, probabilities and distances");
}

io::FrameChoice frame_choice(const std::string& name) {
  if (const auto choice = io::parse_frame_choice(name)) return *choice;
  throw mw::Error(mw::ErrorKind::kUsage, "frame " + name + ": expected file, ras, lps or voxel");
}

io::FormChoice form_choice(const std::string& name) {
  if (name.empty()) return io::FormChoice::kFile;
  if (const auto form = io::parse_form_choice(name)) return *form;
  throw mw::Error(mw::ErrorKind::kUsage, "use_form: '" + name + "' is none of sform and qform");
}

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
  return open(file, {});
}

Volume Volume::open(const VolumeFile& file, const Hooks& hooks) {
  return mw::api::guarded([&] {
    const std::function<void()> stop = mw::api::stop_function(hooks);
    const io::WaitStop waits(&stop);
    io::OpenOptions options{.spacing = file.spacing,
                            .origin = file.origin,
                            .frame = frame_choice(file.frame),
                            .form = form_choice(file.use_form),
                            .dataset = file.dataset,
                            .scale = file.scale,
                            .overlap = overlap_rule(file.overlap),
                            .values = voxel_values(file.values),
                            .object = file.object,
                            .trust_paths = file.trust_paths,
                            .at_once = mw::engine::tbb_for_each_index};
    if (!file.cache.empty()) {
      options.cache =
          mw::api::naming("cache", [&] { return mw::engine::parse_cache_folder(file.cache); });
    }
    if (file.crop) options.crop = mw::api::io_box(*file.crop);
    if (file.scale && *file.scale < 0) {
      throw mw::Error(mw::ErrorKind::kUsage, "scale: levels count from 0, the finest");
    }
    return VolumeAccess::wrap(io::open_volume(mw::api::checked_path(file.path), options));
  });
}

Volume Volume::with_names(const std::vector<LabelName>& names) const {
  return mw::api::guarded([&] {
    return VolumeAccess::wrap(
        std::make_shared<io::NamedVolume>(VolumeAccess::shared(*this), mw::api::io_names(names)));
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
  mw::api::guarded([&] {
    const io::LabelVolume& labels = VolumeAccess::labels(*this);
    const mw::Box3 wanted = mw::api::io_box(box);
    const mw::Box3 common = mw::intersection(wanted, {{0, 0, 0}, labels.info().shape});
    const bool is_inverted =
        wanted.lo.x > wanted.hi.x || wanted.lo.y > wanted.hi.y || wanted.lo.z > wanted.hi.z;
    if (is_inverted || common != wanted ||
        static_cast<std::uint64_t>(wanted.voxels()) != out.size()) {
      throw mw::Error(mw::ErrorKind::kUsage,
                      "read: expected a box in the volume, and room for its voxels");
    }
    if (!out.empty()) labels.read(wanted, out);
  });
}

std::uint64_t find_label(const Volume& volume, std::string_view text) {
  return mw::api::guarded([&] {
    const io::VolumeInfo& info = VolumeAccess::labels(volume).info();
    return mw::engine::find_label(text, info.names, io::has_signed_labels(info));
  });
}

std::string with_label_numbers(const Volume& volume, std::string_view text) {
  return mw::api::guarded([&] {
    mw::engine::check_sizes(text);  // no other setting has labels
    return mw::engine::with_numbers(text, VolumeAccess::labels(volume).info().names);
  });
}

std::vector<LabelName> read_names(const std::filesystem::path& path) {
  return mw::api::guarded(
      [&] { return mw::api::library_names(io::read_names(mw::api::checked_path(path))); });
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
