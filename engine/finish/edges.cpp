// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "kernels/core/vector3.h"

namespace mw::engine {
namespace {

/// The labels of the tets at a vertex.
struct VertexLabels {
  std::uint32_t first = 0;  ///< one more than the dense label of the first tet; 0: none came yet
  std::uint32_t meet = 0;   ///< 1 if another label came
};
using Meetings = io::PagedArray<VertexLabels>;

Meetings meetings_of(io::ScratchMesh& mesh, const io::LabelTable& table) {
  Meetings out(mesh.folder(), mesh.vertex_count());
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      const std::uint32_t label = 1 + table.dense(batch.labels[t]);
      for (const std::uint64_t row : batch.tets[t]) {
        out.change(row, [label](VertexLabels& vertex) {
          if (vertex.first == 0) vertex.first = label;
          if (vertex.first != label) vertex.meet = 1;
        });
      }
    }
  });
  return out;
}

/// Takes tets one by one.
class EdgeMeter {
 public:
  explicit EdgeMeter(const EdgesTask& task) : task_(task) {
    out_.longest.resize(task.table.size());
  }

  /// meet: at which corners labels meet.
  void add(const std::array<io::Position, 4>& corners, Label label,
           const std::array<bool, 4>& meet) {
    const double size = task_.sizes[label];
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double edge = norm(minus(corners[j], corners[i]));
        out_.longest[label] = std::max(out_.longest[label], edge);
        if (size > 0.0) out_.ratios.add(edge / size, meet[i] && meet[j]);
      }
    }
  }
  [[nodiscard]] EdgeFigures& figures() { return out_; }

 private:
  const EdgesTask& task_;
  EdgeFigures out_;
};

}  // namespace

void EdgeRatios::add(double ratio, bool is_at_interface) {
  const auto bound = std::lower_bound(kBounds.begin(), kBounds.end(), ratio) - kBounds.begin();
  ++counts[static_cast<std::size_t>(bound)];
  if (is_at_interface) ++at_interfaces[static_cast<std::size_t>(bound)];
}

EdgeFigures measure_edges(io::ScratchMesh& mesh, const EdgesTask& task,
                          const std::function<void()>& between) {
  Meetings meetings = meetings_of(mesh, task.table);
  EdgeMeter meter(task);
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    between();
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      std::array<bool, 4> meet{};
      for (std::size_t i = 0; i < 4; ++i) meet[i] = meetings.get(batch.tets[t][i]).meet != 0;
      meter.add(mesh.corners(batch.tets[t]), task.table.dense(batch.labels[t]), meet);
    }
  });
  return std::move(meter.figures());
}

std::uint64_t bytes_of_edges() {
  return std::uint64_t{9} << 20U;  // the pages of PagedArray
}

}  // namespace mw::engine
