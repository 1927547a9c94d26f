// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of callers and files.
#include <algorithm>

#include "engine/api/array_volume.h"
#include "engine/api/asked.h"
#include "engine/api/errors.h"
#include "engine/api/spaces.h"
#include "engine/api/watch.h"
#include "engine/settings/named_labels.h"
#include "io/file/errors.h"
#include "io/names/read_names.h"
#include "io/remote/wait_stop.h"
#include "io/volume/decode.h"
#include "io/volume/named_volume.h"
#include "kernels/synth/synth.h"

mw_volume::mw_volume(std::shared_ptr<const mw::io::LabelVolume> labels_in)
    : labels(std::move(labels_in)), names(mw::api::name_rows(labels->info().names)) {}

namespace mw::api {
namespace {

Box3 box_of(const std::int64_t* lo, const std::int64_t* hi) {
  return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
}

/// ERRORS: mw::Error(kUsage) unless the box lies in the volume.
void require_inside(const Box3& box, const Index3& shape) {
  const bool is_inverted = box.lo.x > box.hi.x || box.lo.y > box.hi.y || box.lo.z > box.hi.z;
  if (!is_inverted && intersection(box, {{0, 0, 0}, shape}) == box) return;
  io::fail_usage("read: expected a box in the volume");
}

std::shared_ptr<const io::LabelVolume> open_any(const char* path, const mw_options* options,
                                                const mw_hooks* hooks) {
  Asked asked(options);
  request::VolumeRequest& volume = asked.request().volume;
  volume.path = path;
  if (engine::has_names(asked.options().text("object"))) {
    asked.options().resolve_names([&] { return request::names_of(volume); });
  }
  const Watch watch(hooks);
  const std::function<void()> stop = watch.stop();
  const io::WaitStop waits(&stop);
  return request::open(volume, watch.warn());
}

}  // namespace

std::vector<mw_name> name_rows(const io::LabelNames& names) {
  std::vector<mw_name> out;
  for (const io::LabelName& row : names.rows()) {
    mw_name& to = out.emplace_back(
        mw_name{.label = row.label, .name = row.name.c_str(), .colour = {}, .has_colour = 0});
    if (!row.colour) continue;
    std::ranges::copy(*row.colour, to.colour);
    to.has_colour = 1;
  }
  return out;
}

io::LabelNames label_names(const mw_name* names, std::size_t count) {
  if (count > 0) require(names, "names");
  std::vector<io::LabelName> rows;
  for (const mw_name& name : std::span(names, count)) {
    io::LabelName& row = rows.emplace_back();
    row.label = name.label;
    row.name = name.name == nullptr ? "" : name.name;
    if (name.has_colour != 0) {
      row.colour = {name.colour[0], name.colour[1], name.colour[2], name.colour[3]};
    }
  }
  return io::LabelNames(std::move(rows));
}

}  // namespace mw::api

namespace api = mw::api;
namespace io = mw::io;

mw_volume* mw_volume_open(const char* path, const mw_options* options, const mw_hooks* hooks,
                          mw_error** error) {
  return api::made(error, [&] {
    api::require(path, "path");
    return new mw_volume(api::open_any(path, options, hooks));
  });
}

mw_volume* mw_volume_of_array(const void* data, mw_type type, const int64_t shape[3],
                              const int64_t* strides, const mw_space* space, mw_error** error) {
  return api::made(error, [&] {
    return new mw_volume(
        std::make_shared<api::ArrayReader>(data, api::info_of(type, shape, space), strides));
  });
}

mw_volume* mw_volume_of_reader(mw_type type, const int64_t shape[3], const int64_t* chunk,
                               const mw_space* space,
                               int (*read)(void* data, const int64_t lo[3], const int64_t hi[3],
                                           uint64_t* labels),
                               void* data, mw_error** error) {
  return api::made(error, [&] {
    io::VolumeInfo info = api::info_of(type, shape, space);
    if (chunk != nullptr) {
      if (std::min({chunk[0], chunk[1], chunk[2]}) < 0) {
        io::fail_usage("chunk: must not be negative");
      }
      // Chunks beyond the volume are of no use, and rounding up the largest numbers would overflow.
      info.chunk = {std::min(chunk[0], info.shape.x), std::min(chunk[1], info.shape.y),
                    std::min(chunk[2], info.shape.z)};
    }
    return new mw_volume(std::make_shared<api::RegionReader>(std::move(info), read, data));
  });
}

void mw_volume_free(mw_volume* volume) {
  delete volume;
}

mw_volume* mw_volume_with_names(const mw_volume* volume, const mw_name* names, size_t count,
                                mw_error** error) {
  return api::made(error, [&] {
    api::require(volume, "volume");
    return new mw_volume(
        std::make_shared<io::NamedVolume>(volume->labels, api::label_names(names, count)));
  });
}

mw_volume* mw_volume_read_names(const mw_volume* volume, const char* path, mw_error** error) {
  return api::made(error, [&] {
    api::require(volume, "volume");
    api::require(path, "path");
    return new mw_volume(std::make_shared<io::NamedVolume>(volume->labels, io::read_names(path)));
  });
}

void mw_volume_shape(const mw_volume* volume, int64_t shape[3]) {
  const mw::Index3& from = volume->labels->info().shape;
  shape[0] = from.x;
  shape[1] = from.y;
  shape[2] = from.z;
}

mw_type mw_volume_type(const mw_volume* volume) {
  return static_cast<mw_type>(volume->labels->info().type);
}

int mw_volume_is_signed(const mw_volume* volume) {
  return io::has_signed_labels(volume->labels->info()) ? 1 : 0;
}

void mw_volume_space(const mw_volume* volume, mw_space* space) {
  api::tell_space(volume->labels->info().space, space);
}

size_t mw_volume_names(const mw_volume* volume, const mw_name** names) {
  *names = volume->names.data();
  return volume->names.size();
}

mw_status mw_volume_read(const mw_volume* volume, const int64_t lo[3], const int64_t hi[3],
                         uint64_t* labels, mw_error** error) {
  return api::tried(error, [&] {
    api::require(volume, "volume");
    api::require(lo, "lo");
    api::require(hi, "hi");
    const mw::Box3 box = api::box_of(lo, hi);
    api::require_inside(box, volume->labels->info().shape);
    const auto voxels = static_cast<std::size_t>(box.voxels());
    if (voxels == 0) return;
    api::require(labels, "labels");
    volume->labels->read(box, std::span(labels, voxels));
  });
}

mw_status mw_volume_find_label(const mw_volume* volume, const char* text, uint64_t* label,
                               mw_error** error) {
  return api::tried(error, [&] {
    api::require(volume, "volume");
    api::require(text, "text");
    const io::VolumeInfo& info = volume->labels->info();
    *label = mw::engine::find_label(text, info.names, io::has_signed_labels(info));
  });
}

mw_status mw_synth(const char* kind, const int64_t shape[3], uint64_t labels, uint64_t seed,
                   uint64_t* voxels, mw_error** error) {
  return api::tried(error, [&] {
    api::require(kind, "kind");
    api::require(shape, "shape");
    const std::optional<mw::SynthKind> found = mw::parse_synth_kind(kind);
    if (!found) {
      io::fail_usage("kind ", kind, ": expected voronoi, tubes, spheres, noise or checkerboard");
    }
    const mw::SynthSpec spec{
        .kind = *found, .shape = {shape[0], shape[1], shape[2]}, .labels = labels, .seed = seed};
    mw::check_synth_spec(spec);
    api::require(voxels, "voxels");
    mw::synth_slab(spec, 0, spec.shape.z,
                   std::span(voxels, static_cast<std::size_t>(spec.shape.product())));
  });
}
