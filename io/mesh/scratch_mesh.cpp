// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/scratch_mesh.h"

#include "io/file/scratch/external_sort.h"
#include "kernels/core/assert.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

/// Three ascending rows; 8 * tet + 2 * opposite corner + FacetSide::points_out; label.
using FaceRecords = ExternalSort<5>;

void add_faces(ScratchMesh& mesh, const TetBatch& batch, std::size_t at, FaceRecords& faces) {
  std::array<std::pair<std::uint64_t, std::uint64_t>, 4> rows;  // and corners
  for (std::uint64_t i = 0; i < 4; ++i) rows[i] = {mesh.first_of(batch.tets[at][i]), i};
  std::sort(rows.begin(), rows.end());
  const auto [a, b, c, d] =
      mesh.corners({rows[0].first, rows[1].first, rows[2].first, rows[3].first});
  // The normal of a b c points at d, into the tet, when that is positive.  It turns from one corner
  // that is left out to the next.
  std::uint64_t points_out = volume6(a, b, c, d) > 0 ? 0 : 1;
  for (std::size_t out = 4; out-- > 0; points_out = 1 - points_out) {
    FaceRecords::Record face{0, 0, 0, (batch.first + at) << 3 | rows[out].second << 1 | points_out,
                             batch.labels[at]};
    for (std::size_t i = 0, next = 0; i < 4; ++i) {
      if (i != out) face[next++] = rows[i].first;
    }
    faces.add(face);
  }
}

/// ERRORS: mw::Error(kInput) for a row without a vertex.
template <class At>
std::array<Position, 4> places_of(const TetRows& tet, std::uint64_t vertices, At at) {
  std::array<Position, 4> out{};
  for (std::size_t i = 0; i < tet.size(); ++i) {
    if (tet[i] >= vertices) {
      throw Error(ErrorKind::kInput, text("a tet names vertex ", tet[i], " of ", vertices));
    }
    out[i] = at(tet[i]);
  }
  return out;
}

FacetSide side_of(const FaceRecords::Record& face) {
  return {.tet = face[3] >> 3,
          .label = face[4],
          .opposite = static_cast<std::uint32_t>(face[3] >> 1 & 3),
          .points_out = static_cast<std::uint32_t>(face[3] & 1)};
}

}  // namespace

ScratchMesh::ScratchMesh(const std::filesystem::path& folder)
    : folder_(folder), positions_(folder), tets_(folder), labels_(folder), values_(folder) {}

std::array<Position, 4> ScratchMesh::corners(const TetRows& tet) {
  return places_of(tet, vertex_count(), [this](std::uint64_t row) { return vertex(row); });
}

void ScratchMesh::find_doubles(std::size_t sort_bytes) {
  if (doubles_ || !header_.record.has_doubles) return;
  doubles_.emplace(folder_, sort_bytes);
  each_vertex_batch([&](std::span<const Position> batch) { doubles_->add(batch); });
  doubles_->find();
}

ScratchFile& ScratchMesh::facets(std::size_t sort_bytes, const std::function<void()>& between) {
  if (facets_) return *facets_;
  find_doubles(sort_bytes);
  FaceRecords faces(folder_, sort_bytes);
  each_tet_batch([&](const TetBatch& batch) {
    between();
    for (std::size_t t = 0; t < batch.tets.size(); ++t) add_faces(*this, batch, t, faces);
  });
  ScratchFile facets(folder_);
  MeshFacet facet;
  const auto close = [&] {
    const bool is_inner = facet.tets == 2 && facet.sides[0].label == facet.sides[1].label;
    if (facet.tets > 0 && !is_inner) facets.append(std::as_bytes(std::span(&facet, 1)));
    facet.tets = 0;
  };
  faces.each([&](const FaceRecords::Record& face) {
    const std::array<std::uint64_t, 3> rows{face[0], face[1], face[2]};
    if (rows != facet.rows) close();
    if (facet.tets == 0) facet = {.rows = rows};
    if (facet.tets < facet.sides.size()) facet.sides[facet.tets] = side_of(face);
    ++facet.tets;
  });
  close();
  return facets_.emplace(std::move(facets));
}

void ScratchMesh::add_vertices(std::span<const Position> positions) {
  for (const Position& p : positions) positions_.append(p);
}

void ScratchMesh::add_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && !facets_ && !curved_nodes_);
  tets_.append(std::as_bytes(tets));
  labels_.append(std::as_bytes(labels));
}

void ScratchMesh::add_values(std::span<const double> rows) {
  values_.append(std::as_bytes(rows));
}

void ScratchMesh::add_columns(
    const std::vector<std::string>& names,
    const std::function<void(const TetBatch&, std::size_t, std::vector<double>&)>& add_row) {
  ScratchFile values(folder_);
  std::vector<double> rows;
  const std::size_t width = header_.values.size();
  each_tet_batch([&](const TetBatch& batch) {
    rows.clear();
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      const auto before = batch.values.subspan(t * width, width);
      rows.insert(rows.end(), before.begin(), before.end());
      add_row(batch, t, rows);
    }
    values.append(std::as_bytes(std::span(rows)));
  });
  header_.values.insert(header_.values.end(), names.begin(), names.end());
  values_ = std::move(values);
}

void ScratchMesh::drop_values() {
  header_.values.clear();
  values_ = ScratchFile(folder_);
}

void ScratchMesh::settle() {
  positions_.file().flush();
  tets_.flush();
  labels_.flush();
}

void ScratchMesh::read_tets(std::uint64_t first, std::span<TetRows> tets,
                            std::span<RawLabel> labels) {
  tets_.read_at(first * sizeof(TetRows), std::as_writable_bytes(tets));
  labels_.read_at(first * sizeof(RawLabel), std::as_writable_bytes(labels));
}

void ScratchMesh::each_tet_batch(const std::function<void(const TetBatch&)>& visit) {
  std::vector<TetRows> tets;
  std::vector<RawLabel> labels;
  std::vector<double> values;
  const std::size_t width = header_.values.size();
  for (std::uint64_t first = 0; first < tet_count(); first += tets.size()) {
    const std::size_t count = std::min<std::uint64_t>(kBatchTets, tet_count() - first);
    tets.resize(count);
    labels.resize(count);
    values.resize(count * width);
    read_tets(first, tets, labels);
    values_.read_at(first * width * sizeof(double), std::as_writable_bytes(std::span(values)));
    visit({first, tets, labels, values});
  }
}

std::array<Position, 4> CornerReader::corners(const TetRows& tet) {
  return places_of(tet, vertices_, [this](std::uint64_t row) { return pages_.at(file_, row); });
}

void MeshSink::take(ScratchMesh& mesh, const std::function<void()>& between) {
  begin(mesh.header());
  mesh.each_vertex_batch([&](std::span<const Position> batch) {
    between();
    write_vertices(batch);
  });
  mesh.each_tet_batch([&](const TetBatch& batch) {
    between();
    write_tets(batch.tets, batch.labels);
    if (!mesh.header().values.empty()) write_values(batch.values);
  });
  finish();
}

void ScratchMeshSink::finish() {
  check_sink_counts("mesh", mesh_.header(), mesh_.tet_count());
  complete_();
}

}  // namespace mw::io
