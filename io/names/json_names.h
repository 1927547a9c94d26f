// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels in JSON: nnU-Net's dataset.json, and maps of classes as TotalSegmentator has
// them. Format: https://github.com/MIC-DKFZ/nnUNet/blob/master/documentation/dataset_format.md
// Format: https://github.com/wasserth/TotalSegmentator
#pragma once

#include <string_view>

#include "io/names/label_names.h"

namespace mw::io {

/// Whether the text is an object of JSON, by its first character.
[[nodiscard]] bool is_json_object(std::string_view text);

/// Reads {"liver": 1}, as version 2 of nnU-Net has it, or {"1": "liver"}, as version 1 and
/// TotalSegmentator do: the object at "labels", where there is one, else the document itself, or
/// the only object in it that names labels.  Regions of several labels ("kidney": [1, 2, 3]) are no
/// labels, and are left out.
/// ERRORS: mw::Error(kInput) naming file and field where the text is no JSON, where a label or a
/// name is there twice, and where several objects name labels.
[[nodiscard]] LabelNames parse_json_names(std::string_view text, std::string_view file);

}  // namespace mw::io
