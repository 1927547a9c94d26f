// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an NRRD file as a volume.
#include "io/volume/nrrd/open_nrrd.h"

#include <algorithm>
#include <set>

#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/masks/open_masks.h"
#include "io/volume/number_volume.h"
#include "io/volume/raw_array.h"

namespace mw::io {
namespace {

NrrdHeader read_header(const ByteSource& source) {
  std::string head(source.size_within(kMaxNrrdHeaderBytes), '\0');
  source.read_at(0, std::as_writable_bytes(std::span(head)));
  return parse_nrrd_header(head, source.name());
}

ArrayLayout layout_of(const NrrdHeader& header, const VolumeInfo& info, std::uint64_t offset,
                      std::int64_t layer) {
  ArrayLayout layout{.offset = offset, .order = header.order};
  if (header.layers_first) {
    layout.numbers = header.layers;
    layout.number = layer;
  } else {
    layout.offset += static_cast<std::uint64_t>(layer) * payload_bytes(info);
  }
  return layout;
}

/// Opens layers as numbers.  REQUIRES: the source holds all layers.
std::unique_ptr<LabelVolume> open_numbers(std::unique_ptr<ByteSource> data, const VolumeInfo& info,
                                          std::uint64_t offset, const NrrdHeader& header) {
  const std::shared_ptr<const ByteSource> shared = std::move(data);
  std::vector<std::shared_ptr<const LabelVolume>> parts;
  for (std::int64_t i = 0; i < header.layers; ++i) {
    parts.push_back(
        std::make_shared<RawArrayVolume>(shared, info, layout_of(header, info, offset, i)));
  }
  return std::make_unique<NumberStack>(std::move(parts));
}

void check_segments(const NrrdHeader& header, const std::string& file) {
  if (!header.segments.empty()) return;
  if (header.has_segment_names) {
    fail_input(file, "NRRD keys 'SegmentN_LabelValue' and 'SegmentN_Layer'",
               text("no segment has them, so that nothing says which of the ", header.layers,
                    " layers is whose; old versions of 3D Slicer left them out"),
               "save the segmentation again with a newer 3D Slicer");
  }
  fail_input(file, "NRRD fields 'dimension', 'space directions' and 'kinds'",
             text("one of the axes is none of space and has ", header.layers, " elements"),
             "pick one channel");
}

void check_units(const NrrdHeader& header, const std::string& file, const OpenOptions& options) {
  if (!header.units_differ || options.spacing) return;
  fail_input(file, "NRRD field 'space units'", "the axes have different units",
             "give the size of a voxel in one unit with --spacing");
}

/// What voxels of layers have that is no value of a segment there.
struct Strays {
  std::uint64_t voxels = 0;
  RawLabel first = 0;
};

/// Counts the voxels of a layer that belong to no segment, slab by slab.
void add_strays(const LabelVolume& layer, const std::set<RawLabel>& known, Strays& strays) {
  constexpr std::int64_t kSlabVoxels = 1 << 20;
  const Index3 n = layer.info().shape;
  const std::int64_t rows = std::clamp<std::int64_t>(kSlabVoxels / n.x, 1, n.y);
  std::vector<RawLabel> labels;
  for (std::int64_t z = 0; z < n.z; ++z) {
    for (std::int64_t y = 0; y < n.y; y += rows) {
      const Box3 slab{{0, y, z}, {n.x, std::min(y + rows, n.y), z + 1}};
      labels.resize(static_cast<std::size_t>(slab.voxels()));
      layer.read(slab, labels);
      for (const RawLabel label : labels) {
        if (label == 0 || known.contains(label)) continue;
        if (strays.voxels++ == 0) strays.first = label;
      }
    }
  }
}

/// Returns what is to be said of voxels that belong to no segment; mostly nothing.
std::string note_of_strays(const std::shared_ptr<const ByteSource>& data, const VolumeInfo& info,
                           std::uint64_t offset, const NrrdHeader& header) {
  Strays strays;
  for (std::int64_t layer = 0; layer < header.layers; ++layer) {
    std::set<RawLabel> known;
    for (const Segment& segment : header.segments) {
      if (segment.layer == layer) known.insert(segment.name.label);
    }
    add_strays(RawArrayVolume(data, info, layout_of(header, info, offset, layer)), known, strays);
  }
  if (strays.voxels == 0) return {};
  const std::string value =
      has_signed_labels(info) ? text(static_cast<std::int64_t>(strays.first)) : text(strays.first);
  return text(data->name(), ": ", strays.voxels, " voxels of its layers belong to no segment (",
              value, " is the value of the first), and are left out");
}

/// Merges segments that lie in several layers to labels.
/// REQUIRES: the source holds them.
std::unique_ptr<LabelVolume> open_layers(std::unique_ptr<ByteSource> data, const VolumeInfo& info,
                                         std::uint64_t offset, const NrrdHeader& header,
                                         Overlap overlap) {
  const std::shared_ptr<const ByteSource> shared = std::move(data);
  VolumeInfo noted = info;
  noted.note = note_of_strays(shared, info, offset, header);
  MaskMerger merger(noted, overlap, shared->name());
  for (const Segment& segment : header.segments) {
    const RawArrayVolume layer(shared, info, layout_of(header, info, offset, segment.layer));
    merger.add({.volume = &layer,
                .value = segment.name.label,
                .file = text(shared->name(), ", segment '", segment.name.name, "'"),
                .name = segment.name.name,
                .colour = segment.name.colour});
  }
  return merger.finish();
}

}  // namespace

std::unique_ptr<LabelVolume> open_nrrd(std::unique_ptr<ByteSource> source,
                                       const OpenOptions& options) {
  const std::string file = source->name();
  const NrrdHeader header = read_header(*source);
  check_units(header, file, options);
  VolumeInfo info{.shape = header.shape,
                  .space = placed(file, header.space, options),
                  .type = header.type,
                  .format = "nrrd"};
  info.names = names_of(header.segments);

  const bool is_stack = header.layers > 1 && options.values != VoxelValues::kLabels;
  if (header.layers > 1 && !is_stack) check_segments(header, file);
  const auto layers = static_cast<std::uint64_t>(header.layers);
  const std::uint64_t needed = saturating_product(payload_bytes(info), layers);
  auto [data, offset] = find_nrrd_voxels(std::move(source), header, needed, options.trust_paths);
  check_payload(*data, info, offset, BytesBehind::kIgnored, layers);
  if (is_stack) return open_numbers(std::move(data), info, offset, header);
  if (header.layers > 1) return open_layers(std::move(data), info, offset, header, options.overlap);
  if (header.segments.empty()) refuse_overlap_rule(file, options);
  return std::make_unique<RawArrayVolume>(std::move(data), std::move(info),
                                          ArrayLayout{.offset = offset, .order = header.order});
}

}  // namespace mw::io
