// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines of facts in the order of what one asks first.
#include "engine/report/summary.h"

#include <algorithm>
#include <vector>

#include "engine/report/connect_report.h"
#include "engine/report/figures.h"
#include "engine/report/mesh_facts.h"

namespace mw::report {
namespace {

using io::Json;

/// Returns `7 "liver"` for a row of a label.
std::string text_of_row(const Json& row) {
  const Json* const name = row.find("name");
  return row["label"].dump() + (name == nullptr ? "" : " \"" + name->text() + "\"");
}

std::string edges_text(const Json& report) {
  const Json& unit = report["input"]["unit"];
  const std::string of = unit.is_null() ? "" : " " + unit.text();
  return told("edges       median {edge_median:g}" + of + ", shortest {edge_min:g}" + of + "\n",
              report["quality"]);
}

std::string volumes_text(const Json& report) {
  if (report["shape"].is_null()) return "";
  const Json& worst = report["shape"]["volume_error_worst"];
  if (worst.is_null()) return "";
  const double error = worst["volume_error"].number();
  return "volumes     off by " + std::string(error > 0 ? "+" : "") + format_percent(error, 1) +
         " at most, in label " + text_of_row(worst) +
         told(" ({labels_measured} of 1,000 voxels and more", report["shape"]) +
         without_parts(report) + ")\n";
}

std::string labels_text(const Json& report) {
  const Json& labels = report["labels"];
  if (labels.is_null()) return "";
  const std::uint64_t written = labels["written"].integer(), all = labels["of"].integer();
  std::string out = "labels      " + with_commas(written);
  if (written < all) out += " of " + with_commas(all);
  const char* before = ": ";
  for (const Json& row : labels["first"].elements()) {
    out += before + text_of_row(row);
    before = ", ";
  }
  if (labels["first"].elements().size() < written) out += ", ...";
  const Json& fewest = labels["fewest_tets"];
  if (written > 1 && !fewest.is_null()) {
    out += "; fewest tets: " + with_commas(fewest["tets"].integer()) + " in " + text_of_row(fewest);
  }
  out += "\n";
  if (!labels["zero_is_nothing"].boolean()) return out;
  return out +
         "background  label 0 is left out, as the names say that it is nothing: --background "
         "none keeps it\n";
}

/// Says how near edges are to the sizes asked of their labels, where that was measured.
std::string sizes_text(const Json& size) {
  const Json* const ratios = size.find("edges_over_size");
  if (ratios == nullptr) return "";
  const std::vector<Json>&bounds = (*ratios)["bounds"].elements(),
        &counts = (*ratios)["counts"].elements();
  double all = 0, near = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double from = i == 0 ? 0.0 : bounds[i - 1].number(), count = counts[i].number();
    all += count;
    near += from >= 0.6 && i < bounds.size() ? count : 0;
  }
  if (all == 0) return "";
  return "sizes       " + format_percent(near / all, 1) +
         " of edges are 0.6 to 1.5 of what was asked\n";
}

std::string halvings_text(const Json& report) {
  const std::uint64_t times = report["size"]["halvings"].integer();
  if (times == 0) return "";
  return "halved      " + std::string(times == 1 ? "once" : "twice") +
         ": a size is below the least of the marches, so each of their tets was cut into " +
         (times == 1 ? "8" : "64") +
         told("; none has a radius ratio below {radius_ratio_floor:g}", report["quality"]) + "\n";
}

/// Says what size of edges was found, or by what sizes were multiplied, and what that took.
std::string count_text(const Json& size, const Json& unit) {
  const Json& count = size["count"];
  if (count.is_null()) return "";
  std::string out = told("count       {asked:,} tets were asked: ", count);
  if (count["size"].is_null()) {
    out += told("sizes are multiplied by {scale:g}", count);
  } else {
    out += told("edges of about {size:g}", count) + (unit.is_null() ? "" : " " + unit.text()) +
           told(" (--size {size:g})", count);
  }
  const Json& pilot = count["pilot"];
  if (pilot.is_null()) return out + "\n";
  return out +
         (pilot["meshes"].integer() == 1 ? ", found by 1 pilot mesh"
                                         : told(", found by {meshes} pilot meshes", pilot)) +
         told(" in {seconds:g} s\n", pilot);
}

std::string sample_text(const Json& sample) {
  std::string out = told("sample      {name}: {statistic} of {file}, ", sample);
  const std::string range = told("{least:g} to {most:g}", sample);
  if (range.empty()) return out + "no tet has a value: the image lies elsewhere\n";
  out += range;
  if (sample["tets_partly_outside"].integer() > 0) {
    out += told("; {tets_partly_outside} tets are partly outside of the image", sample);
  }
  if (sample["tets_outside"].integer() > 0) {
    out += told("; {tets_outside} are outside and have NaN", sample);
  }
  return out + "\n";
}

/// Tells what came of options that change labels, sizes, parts or values.
std::string options_text(const Json& report) {
  std::string out;
  if (!report["parts"].is_null()) {
    const std::string changes = changes_text(report["parts"]);
    if (!changes.empty()) out += "parts       " + changes + "\n";
  }
  out += steps_text(report);
  if (!report["size"].is_null()) {
    out += count_text(report["size"], report["input"]["unit"]) + halvings_text(report) +
           sizes_text(report["size"]);
  }
  if (report["samples"].is_null()) return out;
  for (const Json& sample : report["samples"].elements()) out += sample_text(sample);
  return out;
}

/// Names the promises that the run has seen to hold, by the README's table.
std::string checks_text(const Json& report) {
  const Json& certificate = report["certificate"];
  if (certificate.is_null()) return "";
  if (!certificate["made"].boolean())
    return "checks      none: " + certificate["why"].text() + "\n";
  const std::vector<Json>& checks = certificate["checks"].elements();
  const bool has_bound = std::any_of(checks.begin(), checks.end(), [](const Json& check) {
    return check["name"].text() == "P4 distance";
  });
  std::vector<std::string> held{"P1 topology", "P2 fit"};
  if (report["quality"]["radius_ratio_floor"].number() > 0) held.emplace_back("P3 radius ratio");
  if (has_bound) held.emplace_back("P4 distance");
  if (certificate["volumes_not_promised"].is_null()) held.emplace_back("P8 volumes");
  return "checks      " + joined(held, " and ") + " hold" +
         (has_bound ? "" : "; distance had no bound") + "\n";
}

/// Returns whether the axes of the array are those of the world.
bool is_upright(const Json& axes) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (axes.elements()[i].elements()[k].number() != (i == k ? 1 : 0)) return false;
    }
  }
  return true;
}

/// Says what the coordinates are, where the file does.
std::string space_text(const Json& input) {
  std::vector<std::string> words;
  if (input["frame"].text() != "own") words.push_back(input["frame"].text());
  if (!input["unit"].is_null()) words.push_back(input["unit"].text());
  if (!input["axes_xyz"].is_null() && !is_upright(input["axes_xyz"])) {
    words.emplace_back("axes turned");
  }
  return words.empty() ? "" : "coordinates " + joined(words, ", ") + "\n";
}

}  // namespace

std::string without_parts(const Json& report) {
  const Json& parts = report["parts"];
  if (parts.is_null() || parts["found"].integer() == parts["written"].integer()) return "";
  return "; without the parts that are left out";
}

std::string summary_text(const Json& report) {
  std::string out =
      told("tets        {output.tets:,} between {output.vertices:,} vertices\n", report);
  out += edges_text(report);
  out += told(
      "shape       radius ratio {radius_ratio_min:g} at worst, {radius_ratio_mean:g} on "
      "average (1: regular)\n",
      report["quality"]);
  out += volumes_text(report) + labels_text(report) + options_text(report) + checks_text(report);
  out += space_text(report["input"]);
  out += told("time        {wall_s:g} s, with {peak_rss_bytes:b} of memory at most\n",
              report["performance"]);
  const Json& file = report["output"]["file"];
  if (!file.is_null() && !file.text().empty()) out += "file        " + file.text() + "\n";
  return out;
}

std::string attention_text(const Json& report) {
  if (report["attention"].is_null()) return "";
  std::string out;
  for (const Json& line : report["attention"].elements())
    out += "note        " + line.text() + "\n";
  return out +
         told("next        --size {size:g} gives about {tets:,} tets\n", report["suggestion"]);
}

}  // namespace mw::report
