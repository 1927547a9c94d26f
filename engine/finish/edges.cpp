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

/// The edges of some tets.
struct TetEdges {
  EdgeRatios ratios;
  std::vector<std::pair<Label, double>> longest;  ///< by tet: its label, and its longest edge
};

/// Adds a tet; meet says at which of its corners labels meet, and size is that of its label, or 0.
void add_tet(const std::array<io::Position, 4>& corners, const std::array<bool, 4>& meet,
             std::pair<Label, double> label_and_size, TetEdges& out) {
  const auto [label, size] = label_and_size;
  double longest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double edge = norm(minus(corners[j], corners[i]));
      longest = std::max(longest, edge);
      if (size > 0.0) out.ratios.add(edge / size, meet[i] && meet[j]);
    }
  }
  out.longest.emplace_back(label, longest);
}

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
  EdgeFigures out;
  out.longest.resize(task.table.size());
  each_tet_range<TetEdges>(
      mesh, work,
      [&](const TetRange& range, io::CornerReader& corners) {
        TetEdges of_range;
        io::RecordPages<std::byte, 16> pages;
        for (std::size_t t = 0; t < range.tets.size(); ++t) {
          std::array<bool, 4> meet{};
          for (std::size_t i = 0; i < 4; ++i) {
            meet[i] = pages.at(meetings, range.tets[t][i]) != std::byte{0};
          }
          const Label label = task.table.dense(range.labels[t]);
          add_tet(corners.corners(range.tets[t]), meet, {label, task.sizes[label]}, of_range);
        }
        return of_range;
      },
      [&](TetEdges&& of_range) {
        out.ratios.add(of_range.ratios);
        for (const auto& [label, edge] : of_range.longest) {
          out.longest[label] = std::max(out.longest[label], edge);
        }
      });
  return out;
}

std::uint64_t bytes_of_edges() {
  return std::uint64_t{9} << 20U;  // the pages of PagedArray
}

}  // namespace mw::engine
