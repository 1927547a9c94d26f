// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels that stand in headers of volumes: 3D Slicer's segments in .seg.nrrd files, and
// the label table of Connectome Workbench in NIfTI files.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "io/names/label_names.h"

namespace mw::io {

/// Keys and values of an NRRD header ("key:=value"), unescaped.
using NrrdKeys = std::map<std::string, std::string, std::less<>>;

/// SegmentN_Name, SegmentN_LabelValue and SegmentN_Color ("r g b", 0 to 1).  A segment without a
/// label or with a damaged one has no name.
/// ERRORS: mw::Error(kInput) when segments overlap, that is, when some SegmentN_Layer is not 0.
[[nodiscard]] LabelNames segment_names(const NrrdKeys& keys, std::string_view file);

/// Whether the keys are those of segments.
[[nodiscard]] bool has_segments(const NrrdKeys& keys);

/// What to do about segments that overlap.
inline constexpr const char* kSegmentsWayOut =
    "in Slicer, module Segmentations, export the segments to a labelmap and save that, or collapse "
    "them to one layer (Representations, Binary labelmap, Collapse labelmap layers)";

/// The first <LabelTable> of an XML text: <Label Key="1" Red=".." Green=".." Blue=".." Alpha="..">
/// with the name inside, colours from 0 to 1.  Nothing where the text is no such XML; a label with
/// a damaged key or colour has none.
[[nodiscard]] LabelNames parse_label_table(std::string_view xml);

}  // namespace mw::io
