// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels in headers of volumes: 3D Slicer's segments in .seg.nrrd files, and
// the label table of Connectome Workbench in NIfTI files.
// Format: https://slicer.readthedocs.io/en/latest/developer_guide/modules/segmentations.html
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/names/label_names.h"

namespace mw::io {

/// Keys and values of an NRRD header ("key:=value"), unescaped.
using NrrdKeys = std::map<std::string, std::string, std::less<>>;

/// One of 3D Slicer's segments.
struct Segment {
  LabelName name;          ///< its label is the segment's value in its layer
  std::int64_t layer = 0;  ///< where its voxels are; segments of one layer do not overlap
};

/// Reads SegmentN_Name, SegmentN_LabelValue, SegmentN_Layer and SegmentN_Color ("r g b", 0 to 1) in
/// the order of N.  A segment without a value or with a damaged one is left out.
[[nodiscard]] std::vector<Segment> read_segments(const NrrdKeys& keys);
/// Whether any SegmentN has a name, be it without a value.
[[nodiscard]] bool has_segment_names(const NrrdKeys& keys);
/// Returns their names by value, whatever their layers.
[[nodiscard]] LabelNames names_of(const std::vector<Segment>& segments);

/// Reads the first <LabelTable> of an XML text, which has elements <Label Key="1" Red=".."
/// Green=".." Blue=".." Alpha=".."> with the name inside and colours from 0 to 1.  Returns no names
/// where the text is no such XML; skips a label with a damaged key, and a damaged colour.
[[nodiscard]] LabelNames parse_label_table(std::string_view xml);

}  // namespace mw::io
