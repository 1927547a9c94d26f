// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The page of a run, from top to bottom.
#include "engine/cli/page/run_page.h"

#include <algorithm>
#include <cmath>

#include "engine/cli/page/html_text.h"
#include "engine/cli/page/view_data.h"
#include "engine/cli/requests.h"
#include "engine/picture/draw.h"

namespace mw::cli {
namespace {

using io::Json;

/// Returns the shares of a list of counts in their sum.
std::vector<double> shares_of(const Json& counts) {
  double total = 0;
  for (const Json& count : counts.elements()) total += count.number();
  std::vector<double> out;
  for (const Json& count : counts.elements()) {
    out.push_back(total > 0 ? count.number() / total : 0);
  }
  return out;
}

/// Counts volume errors of labels of 1,000 voxels and more; the outermost columns are beyond 5 %.
Histogram volume_errors(const report::FinishedRun& run) {
  constexpr double kMax = 0.05;
  std::array<std::uint64_t, 20> counts{};
  std::uint64_t labels = 0;
  for_each_volume(run, [&](const audit::VolumeRow& row) {
    if (row.voxels < audit::kMinJudgedVoxels) return;
    const double position = (row.error / kMax + 1) / 2 * static_cast<double>(counts.size());
    ++counts[static_cast<std::size_t>(
        std::clamp(position, 0.0, static_cast<double>(counts.size()) - 1))];
    ++labels;
  });
  return {.title = "Volume error",
          .note = with_commas(labels) + " labels of 1,000 voxels and more",
          .from = -100 * kMax,
          .to = 100 * kMax,
          .unit = " %",
          .shares = shares_of(counts)};
}

/// Returns the shares of edges by length; each edge is counted by each of its tets.
std::vector<BarRow> edge_rows(const engine::EdgeRatios& ratios) {
  const std::vector<double> shares = shares_of(ratios.counts);
  std::vector<BarRow> out;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const std::string from = i == 0 ? "0" : format_number(ratios.kBounds[i - 1]);
    const bool is_last = i == ratios.kBounds.size();
    out.push_back({is_last ? "above " + from : from + " to " + format_number(ratios.kBounds[i]),
                   shares[i], format_percent(shares[i], 1)});
  }
  return out;
}

std::string shape_section(const report::FinishedRun& run, const Json& report) {
  const Json& quality = report["quality"];
  const Json& shape = report["shape"];
  std::string out = "<section><h2>Shape</h2><div class=\"charts\">\n";
  out += histogram_figure({.title = "Radius ratio",
                           .note = "of tets; 1 is regular",
                           .shares = shares_of(quality["radius_ratio_histogram"])});
  out += histogram_figure({.title = "Dihedral angle",
                           .note = told("{dihedral_min_deg:1}° to {dihedral_max_deg:1}°", quality),
                           .to = 180,
                           .unit = "°",
                           .shares = shares_of(quality["dihedral_histogram"])});
  std::vector<double> bends;
  for (const Json& share : shape["bend_histogram"].elements()) bends.push_back(share.number());
  bends.resize(bends.size() / 2);
  out += histogram_figure({.title = "Bend of interfaces at edges",
                           .note = told("by length; {sharp_share:2%} beyond 60°", shape),
                           .to = 90,
                           .unit = "°",
                           .shares = std::move(bends)});
  out += histogram_figure(volume_errors(run));
  if (run.sizes.rules.any()) {
    out += bar_figure("Edges, as shares of the size that was asked", edge_rows(run.edges->ratios));
  }
  return out + "</div></section>\n";
}

/// What a page knows of its labels.
struct PageLabels {
  io::GroupedMesh& mesh;
  const io::VolumeSpace& space;
  std::optional<Label> surrounding;
  std::vector<std::optional<audit::VolumeRow>> volumes;  ///< by rank in the mesh

  [[nodiscard]] RawLabel raw(Label rank) const { return mesh.table().raw(rank); }
  [[nodiscard]] std::string digits(Label rank) const {
    return io::label_text(raw(rank), mesh.table().is_signed());
  }
  /// Returns "17.18 mL" or "490 mm³".
  [[nodiscard]] std::string volume(double voxels) const {
    for (const double edge : space.spacing) voxels *= edge;
    std::string out = format_volume(voxels, space.unit);
    return out.ends_with('3') && !space.unit.empty() ? out.replace(out.size() - 1, 1, "³") : out;
  }
};

PageLabels labels_of(const report::FinishedRun& run, io::GroupedMesh& mesh) {
  PageLabels out{.mesh = mesh,
                 .space = run.volume.space,
                 .surrounding = picture::surrounding_label(mesh),
                 .volumes = {}};
  out.volumes.resize(mesh.table().size());
  for_each_volume(run, [&](const audit::VolumeRow& row) {
    const RawLabel raw = run.labels.raw(row.label);
    if (mesh.table().contains(raw)) out.volumes[mesh.table().dense(raw)] = row;
  });
  return out;
}

std::string hex(const picture::Colour& colour) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string out = "#";
  for (const std::uint8_t part : colour) {
    out += kDigits[part >> 4U];
    out += kDigits[part & 15U];
  }
  return out;
}

/// Returns a row of the table of labels; position is the label's index in the view, if it is there.
std::string label_row(const PageLabels& labels, Label rank, std::optional<std::size_t> position) {
  const io::LabelNames& names = labels.mesh.names();
  const std::string swatch =
      "<i style=\"background:" + hex(picture::label_colour(labels.raw(rank), names)) + "\"></i>";
  const std::string digits = labels.digits(rank);
  std::string out = "<tr><td><label>";
  if (position) {
    out += "<input type=\"checkbox\" data-label=\"" + std::to_string(*position) +
           "\" aria-label=\"show " + digits + "\"" +
           (labels.surrounding == rank ? "" : " checked") + ">";
  }
  out += swatch + digits + "</label></td><td>" + escaped(names.name(labels.raw(rank))) +
         "</td><td>" + with_commas(labels.mesh.label_tets()[rank].size()) + "</td>";
  const std::optional<audit::VolumeRow>& volume = labels.volumes[rank];
  if (!volume) return out + "<td></td><td></td><td></td></tr>\n";
  return out + "<td>" + with_commas(volume->voxels) + "</td><td>" +
         escaped(labels.volume(volume->volume_voxels)) + "</td><td>" +
         format_percent(volume->error, 2) + "</td></tr>\n";
}

/// Returns rows of all labels or, if these are too many, of those in the view only.
std::string label_rows(const PageLabels& labels, const ViewData& view) {
  std::string out;
  std::size_t position = 0;
  const bool all = labels.mesh.table().size() <= kMaxViewLabels;
  for (Label rank = 0; rank < labels.mesh.table().size(); ++rank) {
    const bool seen = position < view.labels().size() && view.labels()[position] == rank;
    if (seen) out += label_row(labels, rank, position++);
    if (!seen && all) out += label_row(labels, rank, std::nullopt);
  }
  return out;
}

constexpr const char* kStage =
    R"(<section><h2>Labels</h2><div class="viewer"><div class="card stage">
<div class="screen">
<canvas id="view" tabindex="0" aria-label="the mesh; drag to turn, wheel or two fingers to zoom"></canvas></div>
<p id="no-view" class="soft">This browser shows no WebGL 2; the pictures above are of the same mesh.</p>
<p id="view-note" class="soft">@NOTE@</p>
<div class="controls"><fieldset><span class="soft">Cut</span>
<label><input type="radio" name="cut" value="-1" checked>none</label>
<label><input type="radio" name="cut" value="0">x</label>
<label><input type="radio" name="cut" value="1">y</label>
<label><input type="radio" name="cut" value="2">z</label></fieldset>
<input id="cut-share" type="range" min="0" max="1000" value="500" aria-label="place of the cut" disabled>
<button id="cut-turn" type="button" disabled>Other side</button>
<label><input id="view-edges" type="checkbox">Edges</label>
<button id="view-reset" type="button">Reset</button></div></div>
<div class="card panel"><div class="controls"><input id="labels-find" type="search" placeholder="Find" aria-label="find labels">
<button id="labels-all" type="button">All</button><button id="labels-none" type="button">None</button></div>
<div class="rows"><table id="labels"><thead><tr><th>Label</th><th>Name</th><th>Tets</th><th>Voxels</th><th title="in the mesh">Volume</th><th title="of the volume">Error</th></tr></thead><tbody>
)";

std::string view_note(const ViewData& view) {
  std::string out = "Drag to turn, wheel or two fingers to zoom. " + with_commas(view.triangles()) +
                    " triangles.";
  if (view.left_out() == 0) return out;
  return out + " " + with_commas(view.left_out()) + " smaller labels are not in this page, which " +
         "holds " + with_commas(kMaxViewTriangles) + " triangles and " +
         with_commas(kMaxViewLabels) + " labels at most; they are in the mesh.";
}

std::string label_section(const PageLabels& labels, const ViewData& view) {
  std::string stage = kStage;
  constexpr std::string_view kNote = "@NOTE@";
  stage.replace(stage.find(kNote), kNote.size(), view_note(view));
  return stage + label_rows(labels, view) + "</tbody></table></div></div></div></section>\n";
}

/// Adds the scene as a figure.
void add_picture(io::AtomicFile& file, picture::MeshScene& scene, const std::string& title,
                 picture::PictureStyle style) {
  constexpr int kLetters = 2;  // the page shows pictures at half their size
  style.transparent = true;
  style.letters = kLetters;
  file.append("<figure class=\"card\"><figcaption><b>" + title +
              "</b></figcaption><img width=\"1200\" height=\"900\" alt=\"" + title +
              "\" src=\"data:image/png;base64,");
  Base64 text([&](std::string_view piece) { file.append(piece); });
  draw(scene, style, [&](std::span<const std::byte> bytes) { text.add(bytes); });
  text.finish();
  file.append("\"></figure>\n");
}

/// Adds pictures of all labels except the surrounding one, whole and cut.
void add_pictures(io::AtomicFile& file, const PageLabels& labels) {
  std::vector<bool> shown(labels.volumes.size(), true);
  if (labels.surrounding) shown[*labels.surrounding] = false;
  const picture::Legend legend = picture::legend_of(labels.mesh, shown, labels.mesh.names());
  picture::MeshScene scene(labels.mesh, std::move(shown), labels.mesh.names());
  file.append("<section><h2>Pictures</h2><div class=\"pictures\">\n");
  add_picture(file, scene, "Surfaces", {.view = picture::default_view({}), .legend = legend});
  const picture::CutPosition middle = middle_cut(scene, labels.mesh.box(), 0);
  const picture::View view = picture::default_view(middle);
  scene.cut(cut_plane(labels.mesh.box(), middle, view));
  add_picture(file, scene, "Cut across x", {.view = view, .legend = legend});
  file.append("</div></section>\n");
}

Json view_json(const PageLabels& labels, const ViewData& view) {
  Json out = view.json();
  Json rows = Json::array();
  for (const Label rank : view.labels()) {
    rows.push_back({{"label", labels.digits(rank)},
                    {"colour", picture::label_colour(labels.raw(rank), labels.mesh.names())}});
  }
  out["labels"] = std::move(rows);
  out["frame"] = name(labels.space.frame);
  return out;
}

void add_data(io::AtomicFile& file, const PageLabels& labels, ViewData& view) {
  const auto append = [&](std::string_view piece) { file.append(piece); };
  file.append("<script id=\"view-data\" type=\"application/json\">" +
              script_json(view_json(labels, view)) + "</script>\n");
  file.append("<script id=\"view-vertices\" type=\"text/plain\">");
  view.write_vertices(append);
  file.append("</script>\n<script id=\"view-triangles\" type=\"text/plain\">");
  view.write_triangles(append);
  file.append("</script>\n<script>\n" + std::string(kPageScript) + "</script>\n");
}

/// Returns the top of the page.  Its policy forbids what the page does not do: to ask a network for
/// anything.  Until its script runs, and finds WebGL 2, there is no view.
std::string page_top(const Json& report) {
  return R"(<!DOCTYPE html>
<html lang="en" data-view="none"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<title>)" +
         escaped(report["output"]["file"].text()) + " – mwmesh</title>\n<style>\n" + kPageStyle +
         "</style></head><body>\n";
}

}  // namespace

void write_run_page(io::AtomicFile& file, const report::FinishedRun& run, io::GroupedMesh& mesh,
                    const Json& report) {
  const PageLabels labels = labels_of(run, mesh);
  file.append(page_top(report) + head_section(report) + "<main>\n");
  add_pictures(file, labels);
  ViewData view(mesh, labels.surrounding);
  file.append(label_section(labels, view) + promise_section(report) + shape_section(run, report) +
              engine_section(report) + settings_section(report) +
              "</main>\n<footer>Written by mwmesh.</footer>\n");
  add_data(file, labels, view);
  file.append("</body></html>\n");
  file.commit();
}

}  // namespace mw::cli
