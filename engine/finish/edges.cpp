// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include "kernels/core/vector3.h"

namespace mw::engine {
namespace {

/// The labels of the tets at a vertex.
struct VertexLabels {
  std::uint32_t first = 0;  ///< one more than the dense label of the first tet; 0: none came yet
  std::uint32_t meet = 0;   ///< 1 if another label came
};

/// Writes for each vertex 1 if tets of different labels have it, else 0.
void write_meetings(io::ScratchMesh& mesh, const io::LabelTable& table, io::ScratchFile& out) {
  io::PagedArray<VertexLabels> at_vertex(mesh.folder(), mesh.vertex_count());
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      const std::uint32_t label = 1 + table.dense(batch.labels[t]);
      for (const std::uint64_t row : batch.tets[t]) {
        at_vertex.change(row, [label](VertexLabels& vertex) {
          if (vertex.first == 0) vertex.first = label;
          if (vertex.first != label) vertex.meet = 1;
        });
      }
    }
  });
  for (std::uint64_t row = 0; row < at_vertex.size(); ++row) {
    const std::byte meet{static_cast<unsigned char>(at_vertex.get(row).meet)};
    out.append(std::span(&meet, 1));
  }
  out.flush();
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
  void add(const EdgeMeter& other) {
    std::transform(out_.longest.begin(), out_.longest.end(), other.out_.longest.begin(),
                   out_.longest.begin(), [](double a, double b) { return std::max(a, b); });
    out_.ratios.add(other.out_.ratios);
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

void EdgeRatios::add(const EdgeRatios& other) {
  const auto add = [](const auto& from, auto& to) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
  };
  add(other.counts, counts);
  add(other.at_interfaces, at_interfaces);
}

EdgeFigures measure_edges(io::ScratchMesh& mesh, const EdgesTask& task, const TetWork& work) {
  io::ScratchFile meetings(mesh.folder());
  write_meetings(mesh, task.table, meetings);
  EdgeMeter meter(task);
  each_tet_range<EdgeMeter>(
      mesh, work,
      [&](const TetRange& range, io::CornerReader& corners) {
        EdgeMeter of_range(task);
        io::RecordPages<std::byte, 16> pages;
        for (std::size_t t = 0; t < range.tets.size(); ++t) {
          std::array<bool, 4> meet{};
          for (std::size_t i = 0; i < 4; ++i) {
            meet[i] = pages.at(meetings, range.tets[t][i]) != std::byte{0};
          }
          of_range.add(corners.corners(range.tets[t]), task.table.dense(range.labels[t]), meet);
        }
        return of_range;
      },
      [&](EdgeMeter&& of_range) { meter.add(of_range); });
  return std::move(meter.figures());
}

std::uint64_t bytes_of_edges() {
  return std::uint64_t{9} << 20U;  // the pages of PagedArray
}

}  // namespace mw::engine
