// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A labelled volume through CGAL Mesh_3, from the same files to the same files as mwmesh.
//   cgal_mesh VOLUME -o MESH [--background L] [--report FILE.json]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <optional>

#include "bench/peers/cgal_mesher.h"
#include "engine/report/run_report.h"
#include "engine/system/stopwatch.h"
#include "io/json/json.h"
#include "io/labels/label_table.h"
#include "io/mesh/open_mesh.h"
#include "io/volume/open_volume.h"
#include "kernels/core/error.h"

namespace mw::peers {
namespace {

struct Job {
  std::string volume;
  std::string mesh;
  std::string report;
  std::optional<std::int64_t> background;
  CgalCriteria criteria;
};

/// The rank of a label counts from 1 here: subdomain = dense label + 1.
std::vector<std::uint16_t> subdomains_of(const io::LabelVolume& volume, const io::LabelTable& table,
                                         const Job& job) {
  if (table.size() >= std::numeric_limits<std::uint16_t>::max()) {
    throw Error(ErrorKind::kInput, job.volume + ": more labels than 16 bits hold");
  }
  const Index3 shape = volume.info().shape;
  std::vector<Label> dense(static_cast<std::size_t>(shape.product()));
  io::DenseVolume(volume, table).read({{0, 0, 0}, shape}, dense);
  std::vector<std::uint16_t> out(dense.size());
  std::transform(dense.begin(), dense.end(), out.begin(),
                 [](Label label) { return static_cast<std::uint16_t>(label + 1); });
  if (job.background && table.contains(static_cast<RawLabel>(*job.background))) {
    const auto left_out =
        static_cast<std::uint16_t>(table.dense(static_cast<RawLabel>(*job.background)) + 1);
    std::replace(out.begin(), out.end(), left_out, kOutside);
  }
  return out;
}

io::MeshData with_raw_labels(io::MeshData mesh, const io::LabelTable& table) {
  for (RawLabel& label : mesh.labels) label = table.raw(static_cast<Label>(label - 1));
  mesh.labels_signed = table.is_signed();
  return mesh;
}

/// Keys as in the report of mwmesh.
io::Json report_of(const io::VolumeInfo& info, std::size_t labels, const io::MeshData& mesh,
                   const engine::Resources& used) {
  const auto voxels = static_cast<double>(info.shape.product());
  return {{"input",
           {{"shape_xyz", {info.shape.x, info.shape.y, info.shape.z}},
            {"labels", labels},
            {"voxels", info.shape.product()}}},
          {"output",
           {{"vertices", mesh.vertices.size()},
            {"tets", mesh.tets.size()},
            {"vertex_fraction", report::vertex_fraction(mesh.vertices.size(), info.shape)}}},
          {"performance",
           {{"wall_s", used.wall_seconds},
            {"cpu_s", used.cpu_seconds},
            {"voxels_per_s", voxels / used.wall_seconds},
            {"peak_rss_bytes", used.peak_rss_bytes}}}};
}

void run(const Job& job) {
  const engine::ResourceMeter meter;
  const std::unique_ptr<io::MeshSink> sink = io::open_mesh_sink(job.mesh);
  const std::unique_ptr<io::LabelVolume> volume = io::open_volume(job.volume);
  const io::LabelTable table = io::collect_labels(*volume);
  const io::MeshData mesh = with_raw_labels(
      mesh_with_cgal(subdomains_of(*volume, table, job), volume->info(), job.criteria), table);
  io::write_mesh(mesh, *sink);
  const auto report = report_of(volume->info(), table.size(), mesh, meter.read());
  std::cout << report.dump_indented() << "\n";
  if (job.report.empty()) return;
  std::ofstream out(job.report);
  out << report.dump_indented() << "\n";
  if (!out.flush()) throw Error(ErrorKind::kResource, job.report + ": cannot be written");
}

void add_options(CLI::App& app, Job& job) {
  app.add_option("VOLUME", job.volume, "any volume that mwmesh reads")->required();
  app.add_option("-o", job.mesh, "mesh to write: .vtkhdf, .vtu or .mesh")->required();
  app.add_option("--report", job.report, "writes time, memory and sizes as JSON");
  app.add_option("--background", job.background, "label to leave unmeshed; by default none is");
  app.add_option("--facet-angle", job.criteria.facet_angle, "degrees");
  app.add_option("--facet-size", job.criteria.facet_size, "voxels");
  app.add_option("--facet-distance", job.criteria.facet_distance, "voxels");
  app.add_option("--cell-radius-edge-ratio", job.criteria.cell_radius_edge_ratio);
  app.add_option("--cell-size", job.criteria.cell_size, "voxels");
  const std::map<std::string, Improvement> improvements{
      {"none", Improvement::kNone}, {"timed", Improvement::kTimed}, {"full", Improvement::kFull}};
  app.add_option("--improve", job.criteria.improvement,
                 "perturb and exude: not, as long as CGAL does by default, or without time limit")
      ->transform(CLI::CheckedTransformer(improvements));
}

}  // namespace
}  // namespace mw::peers

int main(int argc, char** argv) {
  try {
    mw::peers::Job job;
    CLI::App app("meshes a labelled volume with CGAL Mesh_3, one thread");
    mw::peers::add_options(app, job);
    CLI11_PARSE(app, argc, argv);
    mw::peers::run(job);
  } catch (const std::exception& error) {
    std::cerr << "cgal_mesh: error: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
