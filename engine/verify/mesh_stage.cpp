// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looks at each tile of the mesh on its own, then puts together what they tell.
#include "engine/verify/mesh_stage.h"

#include <bit>

#include "engine/system/in_order.h"
#include "engine/verify/part_links.h"
#include "kernels/audit/partition/orientation.h"
#include "kernels/audit/partition/overlap.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/audit/topology/parts_union.h"
#include "kernels/core/lattice.h"

namespace mw::engine {
namespace {

/// A tet that other tiles have too.
struct SharedTet {
  std::uint64_t id = 0;
  std::uint32_t part = 0;
};

/// What one tile tells.  Labels of pieces and triangles are those of the whole, others its own.
struct TileFindings {
  TileLabels names{{}, 0};
  audit::ValidityTally validity;
  audit::PartsPiece parts;
  std::vector<SharedTet> shared;
  audit::RegionsPiece regions;  ///< of a mesh with gaps, instead of parts
  audit::JunctionsPiece junctions;
  std::vector<audit::Pinches> pinches;
  audit::Offenders turned{"tets"};
  audit::QualityMeter quality;
  audit::ShapeMeter shape;
  audit::VolumeTally volumes;
  TileShares<audit::CentreRun> centres;
  audit::FaceTally faces;
  TileShares<audit::InterfaceTriangle> triangles;
  audit::PieceEstimates estimates{};  ///< of the triangles
  std::vector<audit::LineCrossing> crossings;
};

/// Turns doubles into words that are in the same order.
std::uint64_t ordered_bits(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits >> 63U != 0 ? ~bits : bits | std::uint64_t{1} << 63U;
}
double of_ordered_bits(std::uint64_t bits) {
  return std::bit_cast<double>(bits >> 63U != 0 ? bits & ~(std::uint64_t{1} << 63U) : ~bits);
}

class MeshStage {
 public:
  MeshStage(MeshTiles& mesh, std::size_t label_count, const audit::ValidityTask& validity,
            const VerifyTask& task, const MeshSinks& sinks)
      : mesh_(mesh),
        validity_(validity),
        task_(task),
        centres_(*sinks.centres),
        pieces_(sinks.pieces),
        junctions_(sinks.junctions),
        lattice_(audit::layered_frame(validity.frame, task.options.layers)),
        lattice_shape_(layered_shape(validity.shape, task.options.layers)),
        parts_(label_count),
        links_(task.folder, task.memory_bytes / 8),
        regions_(label_count, task.folder, task.memory_bytes / 8),
        crossings_(task.folder, task.memory_bytes / 8) {
    found_.validity.in_mesh.resize(label_count + 1);
    found_.pinches.resize(label_count);
    found_.volumes = {std::vector<Int128>(label_count),
                      std::vector<audit::CompensatedSum>(label_count)};
  }

  MeshFindings run() {
    each_in_order<TileFindings>(
        {task_.threads}, mesh_.grid().size(), [this](std::uint32_t tile) { return look_at(tile); },
        [this](std::uint32_t, TileFindings&& found) { merge(std::move(found)); });
    found_.validity.unused.add(mesh_.unused());
    if (validity_.has_gaps) {
      judge_lines();
      found_.betti = regions_.betti();
    } else {
      links_.unite(parts_);
      found_.betti = parts_.betti_of_mesh();
      if (junctions_ != nullptr) junctions_->close(JunctionLedger::Side::kMesh, parts_.cavities());
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] TileFindings look_at(std::uint32_t tile) const {
    const LoadedMesh loaded = mesh_.take_tile(tile);
    const audit::MeshTile view = loaded.view();
    task_.between();
    const audit::MeshStars stars(view);
    task_.between();
    TileFindings out{.names = loaded.names};
    out.validity = audit::tally_validity(stars, {.frame = validity_.frame,
                                                 .shape = validity_.shape,
                                                 .wanted = loaded.names.own(validity_.wanted),
                                                 .has_gaps = validity_.has_gaps});
    if (!loaded.written.empty()) {
      out.turned = audit::changed_orientations(view, loaded.written, mesh_.is_mirrored());
    }
    task_.between();
    if (validity_.has_gaps) {
      take_regions(loaded, stars, out);
    } else {
      take_parts(loaded, stars, out);
    }
    task_.between();
    out.pinches = audit::mesh_pinches(stars, loaded.names.size());
    task_.between();
    out.quality = audit::tally_quality(view);
    out.shape = audit::measure_shape(stars);
    task_.between();
    out.volumes = audit::tally_volumes(view, loaded.names.size(), lattice_);
    take_centres(loaded, out);
    out.faces = audit::tally_faces(view, validity_.frame, validity_.shape, task_.options.periodic);
    task_.between();
    if (pieces_ != nullptr) take_triangles(tile, stars, out);
    task_.between();
    if (junctions_ != nullptr) {
      out.junctions = audit::mesh_junctions(stars, loaded.names.size());
      loaded.names.to_whole(out.junctions);
    }
    return out;
  }

  void take_centres(const LoadedMesh& loaded, TileFindings& out) const {
    for (audit::CentreRun& run :
         audit::centre_runs(loaded.view(), loaded.names.size(), validity_.frame, validity_.shape,
                            task_.options.layers)) {
      run.label = loaded.names.of_whole(run.label);
      for_each_index(mesh_.grid().meeting(audit::voxels_of(run, validity_.shape)),
                     [&](Index3 at) { out.centres.add(mesh_.grid().number(at), run); });
    }
    out.centres.pack();
  }

  static void take_parts(const LoadedMesh& loaded, const audit::MeshStars& stars,
                         TileFindings& out) {
    audit::MeshParts parts = audit::mesh_parts(stars, loaded.names.size());
    out.parts = std::move(parts.piece);
    loaded.names.to_whole(out.parts);
    for (std::size_t t = 0; t < loaded.tets.size(); ++t) {
      if (loaded.is_shared[t]) out.shared.push_back({loaded.tet_ids[t], parts.part_of_tet[t]});
    }
  }

  void take_regions(const LoadedMesh& loaded, const audit::MeshStars& stars,
                    TileFindings& out) const {
    out.regions = audit::regions_of(stars, loaded.names.size());
    loaded.names.to_whole(out.regions);
    out.crossings = audit::line_crossings(stars, validity_.frame, validity_.shape);
  }

  void take_triangles(std::uint32_t tile, const audit::MeshStars& stars, TileFindings& out) const {
    for (audit::InterfaceTriangle& t : audit::interface_triangles(
             stars, out.names.size(), lattice_, lattice_shape_, validity_.has_gaps)) {
      for (Label& label : t.labels) label = out.names.of_whole(label);
      audit::add_estimates(t.corners, out.estimates);
      out.triangles.add(tile, t);
    }
    out.triangles.pack();
  }

  void merge(TileFindings&& found) {
    found_.validity.add(found.validity, found.names.whole());
    found_.turned.add(found.turned);
    for (Label own = 0; own < found.pinches.size(); ++own) {
      found_.pinches[found.names.of_whole(own)].add(found.pinches[own]);
    }
    found_.quality.add(found.quality);
    found_.shape.add(found.shape);
    found_.volumes.add(found.volumes, found.names.whole());
    centres_.add(found.centres);
    found_.faces.add(found.faces);
    const std::uint32_t first = parts_.add(std::move(found.parts));
    for (const SharedTet& tet : found.shared) links_.add(tet.id, 1, first + tet.part);
    regions_.add(found.regions);
    if (pieces_ != nullptr) pieces_->add(found.triangles, found.estimates);
    if (junctions_ != nullptr) junctions_->add(JunctionLedger::Side::kMesh, found.junctions);
    for (const audit::LineCrossing& c : found.crossings) {
      crossings_.add({c.column, ordered_bits(c.z), ordered_bits(c.enters)});
    }
    task_.between();
  }

  void judge_lines() {
    audit::OverlapCheck check(validity_.shape);
    crossings_.each([&](const std::array<std::uint64_t, 3>& c) {
      check.add({c[0], of_ordered_bits(c[1]), static_cast<int>(of_ordered_bits(c[2]))});
    });
    found_.overlap = check.verdict();
  }

  MeshTiles& mesh_;
  const audit::ValidityTask& validity_;
  const VerifyTask& task_;
  CentreBuckets& centres_;
  PieceBuckets* pieces_;
  JunctionLedger* junctions_;
  audit::Frame lattice_;
  Index3 lattice_shape_;
  MeshFindings found_;
  audit::PartsUnion parts_;
  PartLinks links_;
  RegionLinks regions_;
  io::ExternalSort<3> crossings_;
};

}  // namespace

MeshFindings look_at_mesh(MeshTiles& mesh, std::size_t label_count,
                          const audit::ValidityTask& validity, const VerifyTask& task,
                          const MeshSinks& sinks) {
  return MeshStage(mesh, label_count, validity, task, sinks).run();
}

}  // namespace mw::engine
