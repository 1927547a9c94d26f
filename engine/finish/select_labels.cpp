// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/select_labels.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "io/mesh/kept_rows.h"

namespace mw::engine {
namespace {

/// Tells in the header which labels are gone.
void tell_choice(const io::LabelTable& table, const WantedLabel& wanted, io::MeshHeader& header) {
  io::MeshRecord& record = header.record;
  header.names = header.names.only(wanted);
  record.masks = io::only_masks(record.masks, wanted);
  std::erase_if(record.partial_labels, [&](RawLabel label) { return !wanted(label); });
  if (!record.only_labels.empty()) {
    std::erase_if(record.only_labels, [&](RawLabel label) { return !wanted(label); });
    return;
  }
  for (Label label = 0; label < table.size(); ++label) {
    if (!wanted(table.raw(label))) record.without_labels.push_back(table.raw(label));
  }
}

/// Calls visit(number in the batch) on the tets that stay.
template <class Visit>
void each_wanted(const io::TetBatch& batch, const WantedLabel& wanted, Visit visit) {
  for (std::size_t t = 0; t < batch.tets.size(); ++t) {
    if (wanted(batch.labels[t])) visit(t);
  }
}

io::KeptRows used_rows(io::ScratchMesh& mesh, const WantedLabel& wanted) {
  io::KeptRows out = io::KeptRows::none(mesh.vertex_count());
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    each_wanted(batch, wanted, [&](std::size_t t) {
      for (const std::uint64_t row : batch.tets[t]) out.keep(row);
    });
  });
  out.number();
  return out;
}

void add_vertices(io::ScratchMesh& mesh, const io::KeptRows& used, io::ScratchMesh& out) {
  std::uint64_t row = 0;
  std::vector<io::Position> some;
  mesh.each_vertex_batch([&](std::span<const io::Position> batch) {
    some.clear();
    for (const io::Position& p : batch) {
      if (used.stays(row++)) some.push_back(p);
    }
    out.add_vertices(some);
  });
}

void add_tets(const io::TetBatch& batch, const WantedLabel& wanted, const io::KeptRows& used,
              io::ScratchMesh& out) {
  const std::size_t width = out.header().values.size();
  std::vector<io::TetRows> tets;
  std::vector<RawLabel> labels;
  std::vector<double> values;
  each_wanted(batch, wanted, [&](std::size_t t) {
    io::TetRows& tet = tets.emplace_back(batch.tets[t]);
    for (std::uint64_t& row : tet) row = used[row];
    labels.push_back(batch.labels[t]);
    const auto row = batch.values.subspan(t * width, width);
    values.insert(values.end(), row.begin(), row.end());
  });
  out.add_tets(tets, labels);
  out.add_values(values);
}

}  // namespace

io::LabelTable labels_of(io::ScratchMesh& mesh) {
  io::LabelSet found;
  mesh.each_tet_batch([&](const io::TetBatch& batch) { found.insert(batch.labels); });
  return {found.values(), mesh.header().labels_signed};
}

void select_labels(io::ScratchMesh& mesh, const LabelChoice& choice,
                   const std::function<void()>& between) {
  const io::LabelTable table = labels_of(mesh);
  const WantedLabel wanted = wanted_labels(choice, table);
  if (!wanted) return;
  const io::KeptRows used = used_rows(mesh, wanted);
  io::ScratchMesh out(mesh.folder());
  out.header() = mesh.header();
  tell_choice(table, wanted, out.header());
  add_vertices(mesh, used, out);
  mesh.each_tet_batch([&](const io::TetBatch& batch) {
    between();
    add_tets(batch, wanted, used, out);
  });
  out.header().tets = out.tet_count();
  mesh = std::move(out);
}

}  // namespace mw::engine
