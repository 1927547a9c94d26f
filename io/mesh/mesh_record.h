// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a mesh file tells of the run that made it, as a line of JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/mesh_box.h"
#include "io/mesh/mesh_promises.h"
#include "kernels/core/label.h"

namespace mw::io {

/// Where formats that have names for arrays and groups keep it.
inline constexpr const char* kRecordName = "mwmesh";

struct MeshRecord {
  std::optional<MeshBox> box;  ///< of the volume, whether its labels are all in the mesh or not
  std::optional<MeshPromises> promises;
  // What the volume's labels are that the mesh holds; at most one has any, neither where all are.
  std::vector<RawLabel> only_labels;
  std::vector<RawLabel> without_labels;

  friend bool operator==(const MeshRecord&, const MeshRecord&) = default;
};

/// {"box": {"origin": [...], "x": [...], "y": [...], "z": [...]}, "promises": {"max_distance": 1.5,
/// "quality_floor": 0.2, "topology": "labels", "surface": "smooth", "optimizer": "none"},
/// "only_labels": [...], "without_labels": [...]}, without what is not known; empty when nothing
/// is.  Labels are numbers of 64 bits with a sign.  ASCII, no line end; numbers come back to the
/// bit.
[[nodiscard]] std::string record_text(const MeshRecord& record);

/// Nothing of an empty text.  ERRORS: mw::Error(kInput) naming file and field.  Whether a run can
/// have made such promises is not looked at.
[[nodiscard]] MeshRecord parse_record(std::string_view text, std::string_view file);

}  // namespace mw::io
