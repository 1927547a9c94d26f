// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/connect/connect_mesh.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "engine/connect/part_finder.h"
#include "io/mesh/kept_rows.h"

namespace mw::engine {
namespace {

/// Makes the mesh with kept parts and doubled vertices of the one that was looked at.
class ChangedMesh {
 public:
  ChangedMesh(io::ScratchMesh& mesh, PartFinder& finder, const ConnectTask& task)
      : mesh_(mesh), finder_(finder), task_(task), out_(mesh.folder()) {
    out_.header() = mesh.header();
    io::CohesiveRule& cohesive = out_.header().record.cohesive;
    cohesive.all = cohesive.all || task.options.cohesive.all;
    for (const auto& pair : task.options.cohesive.pairs) {
      if (!cohesive.has(pair[0], pair[1])) cohesive.pairs.push_back(pair);
    }
  }

  io::ScratchMesh make(const std::function<void()>& between) {
    ConnectFacts& facts = finder_.facts();
    if (task_.options.parts.leaves_out() && facts.parts < facts.found) mark_used();
    kept_ = used_ ? used_->count() : mesh_.vertex_count();
    facts.vertices = kept_ + facts.copies;
    out_.header().tets = facts.tets;
    out_.header().record.has_doubles = mesh_.header().record.has_doubles || facts.copies > 0;
    add_vertices();
    finder_.each_copied_corner([&](const CopiedCorner& c) { corners_.append(c); });
    mesh_.each_tet_batch([&](const io::TetBatch& batch) {
      between();
      add_tets(batch);
    });
    return std::move(out_);
  }

 private:
  /// Marks the vertices of kept tets, and notes the labels of tets that are left out.
  void mark_used() {
    const std::vector<RawLabel>& before = mesh_.header().record.partial_labels;
    std::set<RawLabel> partial(before.begin(), before.end());
    used_ = io::KeptRows::none(mesh_.vertex_count());
    mesh_.each_tet_batch([&](const io::TetBatch& batch) {
      for (std::size_t t = 0; t < batch.tets.size(); ++t) {
        if (!finder_.keeps(batch.first + t)) {
          partial.insert(batch.labels[t]);
          continue;
        }
        for (const std::uint64_t row : batch.tets[t]) used_->keep(row);
      }
    });
    used_->number();
    out_.header().record.partial_labels.assign(partial.begin(), partial.end());
  }

  void add_vertices() {
    std::uint64_t row = 0;
    std::vector<io::Position> some;
    mesh_.each_vertex_batch([&](std::span<const io::Position> batch) {
      some.clear();
      for (const io::Position& p : batch) {
        if (!used_ || used_->stays(row)) some.push_back(p);
        ++row;
      }
      out_.add_vertices(some);
    });
    finder_.copies().each_batch<std::uint64_t>([&](std::span<const std::uint64_t> rows) {
      some.clear();
      for (const std::uint64_t copied : rows) some.push_back(mesh_.vertex(copied));
      out_.add_vertices(some);
    });
  }

  /// Adds the kept tets of a batch, with copies in the place of doubled vertices.
  void add_tets(const io::TetBatch& batch) {
    const std::size_t width = mesh_.header().values.size();
    std::vector<io::TetRows> tets;
    std::vector<RawLabel> labels;
    std::vector<double> values;
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      const io::TetRows rows = rows_of(batch.first + t, batch.tets[t]);
      if (!finder_.keeps(batch.first + t)) continue;
      tets.push_back(rows);
      labels.push_back(batch.labels[t]);
      const auto row = batch.values.subspan(t * width, width);
      values.insert(values.end(), row.begin(), row.end());
    }
    out_.add_tets(tets, labels);
    out_.add_values(values);
  }

  /// Returns the tet's rows in the new mesh.  REQUIRES: tets come in their order.
  io::TetRows rows_of(std::uint64_t number, const io::TetRows& tet) {
    io::TetRows out = tet;
    for (std::uint64_t& row : out) row = used_ ? (*used_)[row] : row;
    for (; corner_ < corners_.size() && corners_[corner_].tet == number; ++corner_) {
      const CopiedCorner corner = corners_[corner_];
      const auto at = std::find(tet.begin(), tet.end(), corner.row) - tet.begin();
      out[static_cast<std::size_t>(at)] = kept_ + corner.copy;
    }
    return out;
  }

  io::ScratchMesh& mesh_;
  PartFinder& finder_;
  const ConnectTask& task_;
  std::optional<io::KeptRows> used_;  ///< empty if all vertices stay
  std::uint64_t kept_ = 0;            ///< how many stay
  io::ScratchMesh out_;
  io::PagedFile<CopiedCorner, 16> corners_{mesh_.folder()};  ///< ascending by tet
  std::uint64_t corner_ = 0;  ///< the first one that was not looked at
};

void find_places(io::ScratchMesh& mesh, ConnectFacts& facts) {
  facts.vertices = mesh.vertex_count();
  for (PartPlace& part : facts.others) part.place = mesh.vertex(part.row);
  for (HingePlace& hinge : facts.hinges) {
    for (std::size_t end = 0; end < 2; ++end) hinge.places[end] = mesh.vertex(hinge.rows[end]);
  }
}

}  // namespace

std::size_t ConnectTask::memory_of(std::uint64_t budget) {
  constexpr std::uint64_t kMin = 1 << 18;
  return std::clamp<std::uint64_t>(budget / 64, kMin, kMaxMemoryBytes);
}

std::size_t ConnectTask::work_of(std::uint64_t budget, int threads) {
  const std::size_t most = 2 * static_cast<std::size_t>(threads) * StarRange::kBytes;
  return std::clamp<std::uint64_t>(budget / 64, StarRange::kBytes, most);
}

ConnectFacts connect(io::ScratchMesh& mesh, const ConnectTask& task,
                     const std::function<void()>& between) {
  PartFinder finder(mesh, task);
  finder.find(between);
  find_places(mesh, finder.facts());
  if (task.options.change_mesh()) mesh = ChangedMesh(mesh, finder, task).make(between);
  return std::move(finder.facts());
}

std::uint64_t bytes_to_connect(const ConnectTask& task) {
  const std::uint64_t changes = task.options.change_mesh() ? io::ScratchMesh::kBufferBytes : 0;
  return std::uint64_t{task.memory_bytes} + task.work_bytes + (std::uint64_t{5} << 18U) + changes;
}

}  // namespace mw::engine
