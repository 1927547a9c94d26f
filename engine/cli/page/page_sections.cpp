// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The parts of a run's page that come from its report.
#include "engine/cli/page/run_page.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "engine/cli/page/html_text.h"
#include "engine/cli/requests.h"
#include "engine/report/summary.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {
namespace {

using io::Json;

/// Returns a setting as its flag takes it.
std::string flag_text(const Json& value) {
  if (value.is_string()) return value.text();
  if (value.is_float()) return format_number(value.number());
  if (!value.is_array()) return value.dump();
  std::string out;
  for (const Json& part : value.elements()) out += (out.empty() ? "" : ",") + flag_text(part);
  return out;
}

std::string quoted(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,=:+%@";
  if (!word.empty() && word.find_first_not_of(kPlain) == word.npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Returns a figure with its name and a note; value and note are lines for told().
std::string tile(const Json& report, const char* name, const char* value, const std::string& note) {
  const std::string figure = told(value, report);
  return "<div class=\"card tile\"><span>" + std::string(name) + "</span><b>" +
         (figure.empty() ? "–" : figure) + "</b><span>" + note + "</span></div>\n";
}

struct Verdict {
  const char* name;
  const char* promise;
  const char* style;  ///< of the style sheet: pass, fail, open
  std::string word;
  std::string evidence;
};

Verdict judged(const char* name, const char* promise, bool holds, std::string evidence) {
  return {name, promise, holds ? "pass" : "fail", holds ? "holds" : "FAILS", std::move(evidence)};
}

Verdict unchecked(const char* name, const char* promise, std::string evidence) {
  return {name, promise, "open", "not checked here", std::move(evidence)};
}

Verdict shape_verdict(const Json& report) {
  const double min = report["quality"]["radius_ratio_min"].number();
  const double floor = report["quality"]["radius_ratio_floor"].number();
  const std::string found = told("least radius ratio {quality.radius_ratio_min:4}", report);
  constexpr const char* kPromise = "No tet is below the quality floor.";
  if (floor <= 0) return unchecked("P3", kPromise, found + "; the run had no floor");
  return judged("P3", kPromise, min >= floor,
                found + ", floor " + format_number(floor) + ", over all tets as they were written");
}

Verdict memory_verdict(const Json& report) {
  const std::uint64_t peak = report["performance"]["peak_rss_bytes"].integer();
  const std::uint64_t budget = report["engine"]["memory_budget_bytes"].integer();
  return judged(
      "P6", "Resident memory stays under the budget.", peak <= budget,
      told("{performance.peak_rss_bytes:b} at most, budget {engine.memory_budget_bytes:b}",
           report));
}

/// Returns the check of the certificate whose name begins so, or null.
Json check_of(const Json& report, const std::string& name) {
  const Json& certificate = report["certificate"];
  if (!certificate["made"].boolean()) return nullptr;
  for (const Json& check : certificate["checks"].elements()) {
    if (check["name"].text().starts_with(name)) return check;
  }
  return nullptr;
}

/// The certificate knows how rough a label is, on which its bound depends.  Without one, labels are
/// known to be within it where they are within that of a smooth label.
Verdict volume_verdict(const Json& report) {
  constexpr double kSmooth = 0.05;  // the default of verify
  constexpr const char* kPromise = "Labels of 1,000 voxels and more keep their volumes.";
  std::string evidence =
      told("off by {volume_error_max_abs:2%} at most (label {volume_error_worst_label})",
           report["shape"]);
  if (evidence.empty()) return unchecked("P8", kPromise, "no label is that large");
  evidence += report::without_parts(report);
  const Json& why_not = report["certificate"]["volumes_not_promised"];
  if (!why_not.is_null()) {
    return unchecked("P8", kPromise, evidence + "; not promised with " + why_not.text());
  }
  const Json check = check_of(report, "P8");
  if (!check.is_null()) {
    return judged("P8", kPromise, check["passed"].boolean(),
                  evidence + "; nearest to its bound: " + check["detail"].text());
  }
  if (report["shape"]["volume_error_max_abs"].number() <= kSmooth)
    return judged("P8", kPromise, true, evidence + ", 5 % allowed");
  return unchecked("P8", kPromise,
                   evidence + "; rough labels may be off by more than 5 %, verify measures them");
}

Verdict resume_verdict(const Json& report) {
  const bool is_whole = report["engine"]["windows_resumed"].integer() == 0;
  return unchecked(
      "P7", "A killed run goes on to the same bytes.",
      is_whole
          ? "this run was not interrupted"
          : told("{engine.windows_resumed:,} windows were done before it was interrupted", report));
}

/// Returns what the certificate says of a promise or, without one, how to check it.
Verdict certified(const Json& report, const char* name, const char* promise, const char* how) {
  const Json& certificate = report["certificate"];
  if (!certificate["made"].boolean()) return unchecked(name, promise, how);
  bool holds = true;
  for (const Json& check : certificate["checks"].elements()) {
    const bool is_of = check["name"].text().starts_with(name);
    holds = holds && (!is_of || check["passed"].boolean());
  }
  return judged(name, promise, holds, "checked in the mesh before it got its name");
}

Verdict bound_verdict(const Json& report) {
  const Json& bound = report["settings"]["max_distance"];
  constexpr const char* kPromise = "No boundary moves farther than the bound, both ways.";
  if (bound == "none") return unchecked("P4", kPromise, "the run had no bound");
  Verdict out = certified(report, "P4", kPromise, "verify measures it");
  const Json& max = report["distance"]["max_voxels"];
  out.evidence = "bound " + flag_text(bound) + " voxels of the lattice; " +
                 (max.is_null() ? out.evidence : format_fixed(max.number(), 2) + " at most");
  return out;
}

std::vector<Verdict> verdicts(const Json& report) {
  return {
      certified(report, "P1", "Every label keeps its topology, background and exterior included.",
                "kept by every step; verify counts Betti numbers of voxels and mesh"),
      certified(report, "P2",
                "Tets are strictly positive, the mesh is conforming, the box is whole.",
                "kept by every step; verify decides it by exact arithmetic"),
      shape_verdict(report),
      bound_verdict(report),
      unchecked("P5", "The mesh is a function of volume and settings alone.",
                "the same run anywhere gives " + report["digest"].text()),
      memory_verdict(report),
      resume_verdict(report),
      volume_verdict(report)};
}

std::string promise_row(const Verdict& verdict) {
  return "<tr><th scope=\"row\">" + std::string(verdict.name) + "</th><td>" +
         escaped(verdict.promise) + "<small>" + escaped(verdict.evidence) +
         "</small></td><td class=\"" + verdict.style + "\">" + escaped(verdict.word) +
         "</td></tr>\n";
}

/// Returns stages as shares.  In seconds they would add up to neither of the run's times, as they
/// hold the time that threads wait for each other and for a processor.
std::vector<BarRow> stage_rows(const Json& stages) {
  double total = 0;
  for (const auto& [key, value] : stages.items()) total += value.number();
  std::vector<BarRow> out;
  for (const auto& [key, value] : stages.items()) {
    const double share = total > 0 ? value.number() / total : 0;
    // Keys end in "_s", which people need not read.
    if (share > 0) out.push_back({key.substr(0, key.size() - 2), share, format_percent(share, 1)});
  }
  return out;
}

std::vector<BarRow> memory_rows(const Json& purposes) {
  std::vector<BarRow> out;
  for (const auto& [key, value] : purposes.items()) {
    const std::uint64_t bytes = value.integer();
    out.push_back({key, static_cast<double>(bytes), format_bytes(bytes)});
  }
  return out;
}

/// Returns whether an option of the input is not given, or is given as its default.
bool is_fallback(const std::string& key, const Json& value) {
  return value.is_null() || (value.is_boolean() && !value.boolean()) ||
         (key == "frame" && value == "file") || (key == "values" && value == "labels");
}

std::string facts_table(const std::vector<std::array<std::string, 2>>& rows) {
  std::string out = "<table class=\"settings\">";
  for (const auto& [name, value] : rows) {
    out += "<tr><th scope=\"row\">" + escaped(name) + "</th><td>" + escaped(value) + "</td></tr>";
  }
  return out + "</table>";
}

}  // namespace

/// What the run promised is in the mesh, so verify need only be told which voxels were meshed.
std::string verify_command(const Json& report) {
  constexpr std::array kNeeded{"spacing",     "origin", "frame",       "use_form",
                               "shape",       "dtype",  "dataset",     "scale",
                               "overlap",     "values", "crop",        "object",
                               "trust_paths", "merge",  "drop_specks", "interpolate_slices",
                               "weld",        "names"};
  const Json& settings = report["settings"];
  std::string out = "mwmesh verify " + quoted(flag_text(settings["input"])) + " " +
                    quoted(flag_text(settings["output"]));
  for (const std::string key : kNeeded) {
    if (!settings.contains(key) || is_fallback(key, settings[key])) continue;
    std::string flag = key;
    std::replace(flag.begin(), flag.end(), '_', '-');
    out += " --" + flag;
    if (!settings[key].is_boolean()) out += " " + quoted(flag_text(settings[key]));
  }
  return out;
}

std::string head_section(const Json& report) {
  const std::filesystem::path mesh = report["output"]["file"].text();
  std::string voxels;
  for (const Json& side : report["input"]["shape_xyz"].elements()) {
    voxels += (voxels.empty() ? "" : " × ") + with_commas(side.integer());
  }
  const bool has_slivers = report["quality"]["sliver_fraction"].number() > 0;
  const std::string error = told("{shape.volume_error_mean_abs:3%} on average", report);
  return "<header><h1>" + escaped(mesh.filename().string()) + "</h1><p>" +
         escaped(flag_text(report["settings"]["input"])) + " · " + voxels +
         told(" voxels · {input.labels:,} labels · mwmesh {version}</p>\n<div class=\"tiles\">\n",
              report) +
         tile(report, "vertices", "{output.vertices:,}",
              told("{output.vertex_fraction:2%} of the voxel corners", report)) +
         tile(report, "tets", "{output.tets:,}",
              has_slivers ? told("{quality.sliver_fraction:3%} slivers", report) : "no slivers") +
         tile(report, "radius ratio, least", "{quality.radius_ratio_min:3}",
              told("{quality.radius_ratio_mean:3} on average", report)) +
         tile(report, "volume error, at most", "{shape.volume_error_max_abs:2%}",
              error.empty() ? "no label of 1,000 voxels" : error) +
         tile(report, "time on the clock", "{performance.wall_s:n} s",
              told("{performance.cpu_s:n} s of CPU", report)) +
         tile(report, "memory, at most", "{performance.peak_rss_bytes:b}",
              told("{engine.memory_budget_bytes:b} allowed", report)) +
         "</div></header>\n";
}

std::string promise_section(const Json& report) {
  std::string out = "<section><h2>Promises</h2><div class=\"card\"><table class=\"promises\">\n";
  for (const Verdict& verdict : verdicts(report)) out += promise_row(verdict);
  out += "</table></div>\n";
  const std::string mesh = flag_text(report["settings"]["output"]);
  if (!io::is_read_mesh_path(mesh)) return out + "</section>\n";
  return out +
         "<p class=\"soft\" style=\"margin-top:10px\">A second opinion on all of them: <code>" +
         escaped(verify_command(report)) + "</code></p></section>\n";
}

std::string engine_section(const Json& report) {
  std::string out = "<section><h2>Engine</h2><div class=\"charts\">\n";
  out += bar_figure("Where the threads' time went", stage_rows(report["performance"]["stages"]));
  out += bar_figure("Memory reserved, of which less is used",
                    memory_rows(report["engine"]["peak_bytes_by_purpose"]));
  std::vector<std::array<std::string, 2>> rows{
      {"windows", "{engine.windows:,}"},
      {"threads", "{engine.threads:,}"},
      {"time on the clock", "{performance.wall_s:n} s"},
      {"CPU time of all threads", "{performance.cpu_s:n} s"},
      {"voxels/s", "{performance.voxels_per_s:n}"},
      {"blocks spilled", "{engine.blocks_spilled:,}"},
      {"bytes written", "{engine.bytes_written:b}"},
      {"bytes read", "{engine.bytes_read:b}"}};
  for (auto& [name, value] : rows) value = told(value, report);
  out += "<figure class=\"card\"><figcaption><b>Run</b></figcaption>" + facts_table(rows) +
         "</figure>\n";
  return out + "</div></section>\n";
}

std::string settings_section(const Json& report) {
  std::vector<std::array<std::string, 2>> rows;
  for (const auto& [key, value] : report["settings"].items()) {
    if (!value.is_null()) rows.push_back({key, flag_text(value)});
  }
  rows.push_back({"digest", report["digest"].text()});
  return "<section><h2>Settings</h2><details class=\"card\"><summary>All settings of the run, and "
         "the digest of the mesh</summary>" +
         facts_table(rows) + "</details></section>\n";
}

}  // namespace mw::cli
