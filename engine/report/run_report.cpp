// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The report of a run of `mwmesh mesh`.
#include "engine/report/run_report.h"

#include "engine/version.h"

#include <algorithm>

#include "engine/report/attention.h"
#include "engine/report/connect_report.h"
#include "engine/report/mesh_facts.h"
#include "engine/report/verify_report.h"

namespace mw::report {
namespace {

using io::Json;

Json input_json(const FinishedRun& run) {
  const io::VolumeInfo& info = run.volume;
  return {{"format", info.format},
          {"type", io::name(info.type)},
          {"shape_xyz", {info.shape.x, info.shape.y, info.shape.z}},
          {"spacing_xyz", info.space.spacing},
          {"origin_xyz", info.space.origin},
          {"axes_xyz", info.space.axes},
          {"frame", io::name(info.space.frame)},
          {"unit", info.space.unit.empty() ? Json() : Json(info.space.unit)},
          {"spacing_is_known", info.space.is_sized},
          {"labels", run.labels.size()},
          {"voxels", info.shape.product()}};
}

/// Returns the lattice, in which --window, --max-distance and --target-reduction count.
Json lattice_json(const engine::LatticeFacts& lattice) {
  return {{"shape_xyz", index_json(lattice.shape)},
          {"spacing_xyz", lattice.spacing},
          {"layers_xyz", index_json(lattice.layers)}};
}

/// Returns the samples; least and most are null if no tet has a value.
Json samples_json(const std::vector<engine::SampleFacts>& samples) {
  Json out = Json::array();
  for (const engine::SampleFacts& sample : samples) {
    const bool is_empty = sample.tets == sample.outside;
    out.push_back({{"name", sample.name},
                   {"file", sample.file},
                   {"statistic", name(sample.statistic)},
                   {"least", is_empty ? Json() : Json(sample.least)},
                   {"most", is_empty ? Json() : Json(sample.most)},
                   {"tets_partly_outside", sample.partly_outside},
                   {"tets_outside", sample.outside}});
  }
  return out;
}

Json output_json(const FinishedRun& run, const std::filesystem::path& path) {
  return {{"file", path.string()},
          {"vertices", run.engine.vertices},
          {"tets", run.engine.tets},
          {"vertex_fraction", vertex_fraction(run.engine.vertices, run.volume.shape)}};
}

/// Returns how many labels are written, the first few, and the one with the fewest tets.
Json labels_json(const FinishedRun& run) {
  if (!run.amounts) return nullptr;
  const auto row_of = [&](Label label) {
    Json row = named_row_json(run.labels.raw(label), run.labels.is_signed(), run.volume.names);
    row["tets"] = run.amounts->tets[label];
    return row;
  };
  Json first = Json::array();
  std::uint64_t written = 0;
  std::optional<Label> fewest;
  for (Label label = 0; label < run.labels.size(); ++label) {
    const std::uint64_t tets = run.amounts->tets[label];
    if (tets == 0) continue;
    if (!fewest || tets < run.amounts->tets[*fewest]) fewest = label;
    if (++written <= kMostFirstLabels) first.push_back(row_of(label));
  }
  return {{"written", written},
          {"of", run.labels.size()},
          {"zero_is_nothing", run.leaves_out_zero},
          {"first", std::move(first)},
          {"fewest_tets", fewest ? row_of(*fewest) : Json()}};
}

/// Returns what each stage took of all threads, and of the one that was alone where that is known.
Json costs_json(const FinishedRun& run) {
  Json out = Json::array();
  for (const engine::StageCost& stage : run.stages) {
    const bool is_known = run.engine.threads == 1;
    out.push_back({{"name", stage.name},
                   {"cpu_s", stage.cpu_seconds},
                   {"alone_s", is_known ? Json(stage.alone_seconds) : Json()}});
  }
  return out;
}

Json performance_json(const FinishedRun& run) {
  const auto voxels = static_cast<double>(run.volume.shape.product());
  const double rate = voxels / run.resources.wall_seconds;
  const engine::RunReport& engine = run.engine;
  return {{"wall_s", run.resources.wall_seconds},
          {"cpu_s", run.resources.cpu_seconds},
          {"voxels_per_s", rate},
          {"voxels_per_s_per_core", rate / engine.threads},
          {"peak_rss_bytes", run.resources.peak_rss_bytes},
          {"costs", costs_json(run)},
          {"stages",
           {{"labels_s", run.labels_seconds},
            {"prepare_s", engine.prepare_seconds},
            {"start_s", engine.start_seconds},
            {"simplify_s", engine.simplify_seconds},
            {"optimise_s", engine.optimise_seconds},
            {"codt_s", engine.codt_seconds},
            {"exchange_s", engine.exchange_seconds},
            {"output_s", engine.output_seconds}}}};
}

Json codt_json(const engine::RunReport& run) {
  const CodtStats& codt = run.codt;
  return {{"windows", codt.windows},
          {"iterations", codt.iterations},
          {"vertices_moved", codt.moves},
          {"vertices_added", codt.added},
          {"patches", codt.replaced.patches},
          {"patches_unproved", codt.replaced.unproved},
          {"patches_unimproved", codt.replaced.unimproved},
          {"fallbacks", codt.fallbacks},
          {"workers_restarted", run.workers->restarted},
          {"seconds", run.codt_seconds}};
}

Json purposes_json(const std::array<std::uint64_t, engine::kPurposes>& peaks) {
  Json out;
  for (std::size_t i = 0; i < engine::kPurposes; ++i) out[engine::kPurposeNames[i]] = peaks[i];
  return out;
}

Json rank_json(const engine::ProcessFacts& rank) {
  return {{"windows", rank.windows},
          {"blocks_sent", rank.blocks_sent},
          {"bytes_sent", rank.bytes_sent},
          {"peak_accounted_bytes", rank.peak_accounted_bytes},
          {"peak_bytes_by_purpose", purposes_json(rank.peak_bytes_by_purpose)}};
}

Json keep_json(const engine::KeepFacts& keep) {
  Json out{{"voxels_read", keep.voxels_read},
           {"bytes_written", keep.bytes_written},
           {"folder_bytes", keep.bytes_kept}};
  for (const engine::KeepFacts::March& march : keep.marches) {
    out["marches"].push_back({{"visited", march.visited}, {"skipped", march.skipped}});
  }
  return out;
}

Json engine_json(const FinishedRun& run) {
  const engine::StoreFacts& store = run.engine.store;
  Json out{{"windows", run.engine.windows},
           {"windows_resumed", store.resumed_windows},
           {"threads", run.engine.threads},
           {"inner_quality", run.engine.inner_quality},
           {"memory_budget_bytes", run.engine.memory_budget_bytes},
           {"peak_accounted_bytes", run.engine.peak_accounted_bytes},
           {"peak_bytes_by_purpose", purposes_json(run.engine.peak_bytes_by_purpose)},
           {"blocks_spilled", store.blocks_spilled},
           {"bytes_written", store.bytes_written},
           {"bytes_read", store.bytes_read}};
  for (const engine::ProcessFacts& rank : run.engine.processes)
    out["ranks"].push_back(rank_json(rank));
  if (run.engine.keep) out["remesh"] = keep_json(*run.engine.keep);
  if (run.engine.workers) out["codt"] = codt_json(run.engine);
  return out;
}

/// Returns the volumes, and what is known of interfaces.
Json shape_json(const FinishedRun& run) {
  if (!run.amounts) return nullptr;
  audit::VolumeMeter volumes;
  for_each_volume(run, [&](const audit::VolumeRow& row) { volumes.add(row); });
  const audit::VolumeSummary summary = volumes.summary();
  Json out = volume_summary_json(summary, run.labels);
  out["volume_error_worst"] =
      summary.worst ? volume_row_json(*summary.worst, run.labels, run.volume.names) : Json();
  if (!run.figures || !run.figures->has_shape) return out;
  out.update(interfaces_json(run.figures->shape));
  out["bend_histogram"] = run.figures->shape.bend_histogram;
  out["per_label"] = kRows;
  return out;
}

Json run_quality_json(const FinishedRun& run) {
  if (!run.figures) return nullptr;
  Json out = quality_json(run.figures->quality);
  out["radius_ratio_floor"] = run.radius_ratio_floor;
  return out;
}

Json count_json(const FinishedRun& run) {
  if (!run.count) return nullptr;
  const CountFacts& count = *run.count;
  Json pilot = nullptr;
  if (count.trials > 0) {
    pilot = {{"meshes", count.trials},
             {"voxels", count.voxels},
             {"seconds", count.seconds},
             {"expected", count.expected}};
  }
  const engine::SizeRules& rules = run.sizes.rules;
  const bool is_one = rules.labels.empty() && rules.interfaces.empty() && rules.image.empty();
  return {{"asked", count.asked},
          {"got", run.engine.tets},
          {"size", is_one && rules.others ? Json(*rules.others) : Json()},
          {"scale", count.scale},
          {"is_least", count.is_least},
          {"is_most", count.is_most},
          {"labels_without_size", count.labels_without_size},
          {"pilot", std::move(pilot)}};
}

/// Returns the thin parts that --across found, with thicknesses in physical units.
Json across_json(const FinishedRun& run) {
  if (run.sizes.across == 0) return nullptr;
  const engine::ThinParts& parts = run.engine.thin_parts;
  const auto& spacing = run.engine.lattice.spacing;
  const double voxel = *std::min_element(spacing.begin(), spacing.end());
  return {{"asked", run.sizes.across},
          {"voxels", parts.voxels},
          {"voxels_too_thin", parts.too_thin},
          {"least_thickness", parts.least * voxel}};
}

/// Returns the interfaces with sizes of their own that the mesh does not have; null if not looked
/// at.
Json unmet_json(const FinishedRun& run) {
  if (!run.connected) return nullptr;
  return pairs_json(run.connected->unmet, run.labels.is_signed());
}

/// Returns what was asked of sizes; the rows of labels have each label's own and its longest edge.
Json size_json(const FinishedRun& run) {
  Json out{{"labels", run.sizes.rules.labels.size()},
           {"halvings", run.engine.halvings},
           {"inner_vertices_added", run.engine.inner_vertices},
           {"count", count_json(run)},
           {"across", across_json(run)},
           {"image_voxels_raised", run.raised.voxels},
           {"labels_that_do_not_meet", unmet_json(run)}};
  // Edges are compared with the sizes of labels only.
  if (run.sizes.rules.labels.empty() && !run.sizes.rules.others) return out;
  const engine::EdgeRatios& ratios = run.edges->ratios;
  out["edges_over_size"] = {{"bounds", ratios.kBounds}, {"counts", ratios.counts}};
  return out;
}

/// Adds size and longest edge to the row of a label that has a limit on its edges.
void add_size(Label label, const FinishedRun& run, Json& row) {
  const std::optional<double> size = run.sizes.rules.of_label(run.labels.raw(label));
  if (!size) return;
  row["size"] = *size;
  row["longest_edge"] = run.edges->longest[label];
}

/// Returns the distances over all labels; there are none of single labels.
Json run_distance_json(const FinishedRun& run) {
  Json out{{"max_voxels", nullptr}, {"mean_voxels", nullptr}, {"per_label", nullptr}};
  if (!run.certificate || !run.certificate->distance) return out;
  out["max_voxels"] = run.certificate->distance->max_voxels;
  out["mean_voxels"] = run.certificate->distance->mean_voxels;
  return out;
}

Json topology_json(const FinishedRun& run) {
  if (!run.certificate) return {{"checked", false}, {"labels_changed", nullptr}};
  return {{"checked", true}, {"labels_changed", run.certificate->labels_changed.size()}};
}

Json certificate_json(const FinishedRun& run) {
  const Json why_no_volumes = run.why_no_volumes.empty() ? Json() : Json(run.why_no_volumes);
  if (!run.certificate) {
    return {
        {"made", false}, {"why", run.why_no_certificate}, {"volumes_not_promised", why_no_volumes}};
  }
  return {{"made", true},
          {"volumes_not_promised", why_no_volumes},
          {"label_fingerprint", run.fingerprint},
          {"volume", run.certificate->validity.volume},
          {"box_volume", run.certificate->validity.box_volume},
          {"checks", checks_json(*run.certificate)}};
}

}  // namespace

void FinishedRun::take(const engine::FinishFacts& facts) {
  engine.vertices = facts.vertices;
  engine.tets = facts.tets;
  certificate = facts.certificate;
  connected = facts.connected;
  edges = facts.edges;
  amounts = facts.amounts;
  figures = facts.figures;
}

double vertex_fraction(std::uint64_t vertices, Index3 shape) {
  const Index3 corners = shape + Index3{1, 1, 1};
  return static_cast<double>(vertices) / static_cast<double>(corners.product());
}

void for_each_volume(const FinishedRun& run,
                     const std::function<void(const audit::VolumeRow&)>& visit) {
  const engine::RunReport& engine = run.engine;
  const std::int64_t parts = engine.lattice.layers.product();
  for (Label label = 0; label < engine.label_voxels.size(); ++label) {
    const std::uint64_t voxels = engine.label_voxels[label] / static_cast<std::uint64_t>(parts);
    if (voxels > 0) visit(audit::volume_row(label, voxels, run.amounts->volumes6[label], parts));
  }
}

Json run_report(const FinishedRun& run, const std::filesystem::path& mesh, Json settings) {
  Json out{{"version", engine::version()},
           {"settings", std::move(settings)},
           {"input", input_json(run)},
           {"specks", specks_json(run.specks)},
           {"interpolated", slices_json(run.slices)},
           {"welds", welds_json(run.welds)},
           {"samples", samples_json(run.samples)},
           {"lattice", lattice_json(run.engine.lattice)},
           {"output", output_json(run, mesh)},
           {"labels", labels_json(run)},
           {"parts", run.connected ? connect_json(*run.connected, run.labels.is_signed()) : Json()},
           {"quality", run_quality_json(run)},
           {"shape", shape_json(run)},
           {"size", size_json(run)},
           {"distance", run_distance_json(run)},
           {"topology", topology_json(run)},
           {"certificate", certificate_json(run)},
           {"performance", performance_json(run)},
           {"engine", engine_json(run)},
           {"digest", run.digest.empty() ? Json() : Json(run.digest)},
           {"attention", attention(run)},
           {"suggestion", suggestion(run)}};
  if (run.delta) out["delta"] = *run.delta;
  return out;
}

void append_run_report(const FinishedRun& run, const std::filesystem::path& mesh, Json settings,
                       const AppendText& append) {
  const auto for_each_row = [&](const TakeRow& take) {
    for_each_volume(run, [&](const audit::VolumeRow& row) {
      Json out = volume_row_json(row, run.labels, run.volume.names);
      out["tets"] = run.amounts->tets[row.label];
      add_size(row.label, run, out);
      if (run.certificate) add_topology(row.label, *run.certificate, out);
      take(out);
    });
  };
  append_with_rows(run_report(run, mesh, std::move(settings)), for_each_row, append);
}

void write_run_report(io::AtomicFile& file, const FinishedRun& run,
                      const std::filesystem::path& mesh, Json settings) {
  append_run_report(run, mesh, std::move(settings),
                    [&](std::string_view text) { file.append(text); });
  file.commit();
}

}  // namespace mw::report
