// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is asked of a mesh between the marches, or a file, and the file that is written; and what
// was found about it on the way.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/connect/connect_mesh.h"
#include "engine/finish/certificate.h"
#include "engine/finish/cut.h"
#include "engine/finish/edges.h"
#include "engine/finish/figures.h"
#include "engine/finish/label_volumes.h"
#include "engine/output/label_selection.h"
#include "engine/sample/image_sampler.h"
#include "engine/system/stages.h"
#include "kernels/audit/audit.h"

namespace mw::engine {

/// Each member is what one pass is asked to do (passes.cpp).
struct FinishTask {
  LabelChoice labels{};  ///< labels that are left out of a mesh that has them
  CutTask cut{};
  std::optional<CertificateTask> certificate{};
  ConnectTask connect{};
  bool finds_parts = false;  ///< whether parts and hinges are counted where the mesh stays as it is
  ImageSampler* samples = nullptr;  ///< outlives the task
  std::optional<EdgesTask> edges{};
  std::optional<VolumesTask> volumes{};
  std::optional<FiguresTask> figures{};
  bool leaves_values_out = false;
  bool is_curved = false;                 ///< whether sinks of Element::kCurvedTet10 get the mesh
  std::function<void()> between = [] {};  ///< called often; may throw
  StageMeter* stages = nullptr;           ///< optional; each pass is a stage, and so is the file
};

struct FinishFacts {
  std::uint64_t vertices = 0;  ///< of the mesh behind all passes
  std::uint64_t tets = 0;
  std::optional<audit::AuditReport> certificate;
  std::optional<ConnectFacts> connected;
  std::optional<EdgeFigures> edges;
  std::optional<LabelAmounts> amounts;
  std::optional<MeshFigures> figures;
};

}  // namespace mw::engine
