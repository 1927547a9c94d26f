// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/volume_delta.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "engine/labels/label_scan.h"
#include "engine/labels/reading_tiles.h"
#include "engine/report/mesh_facts.h"
#include "engine/system/crew.h"
#include "engine/verify/tile_grid.h"
#include "engine/verify/volume_stage.h"
#include "io/labels/label_table.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

/// Returns the labels of voxels that changed, both of before and after.
std::set<RawLabel> compare(const io::LabelVolume& before, const io::LabelVolume& after, int readers,
                           VolumeDelta& out) {
  std::set<RawLabel> touched;
  std::mutex noting;
  const ReadingTiles tiles(after.info());
  tbb_for_each_index(readers, tiles.count(), [&](Index3 tile) {
    const Box3 box = tiles.box(tile);
    std::vector<RawLabel> old_labels(static_cast<std::size_t>(box.voxels()));
    std::vector<RawLabel> new_labels(old_labels.size());
    before.read(box, old_labels);
    after.read(box, new_labels);
    if (old_labels == new_labels) return;
    const std::lock_guard turn(noting);
    std::size_t at = 0;
    for_each_index(box, [&](Index3 voxel) {
      const RawLabel was = old_labels[at], is = new_labels[at];
      ++at;
      if (was == is) return;
      ++out.voxels;
      out.box = hull(out.box, {voxel, voxel + Index3{1, 1, 1}});
      touched.insert({was, is});
    });
  });
  return touched;
}

using FactsByLabel = std::map<RawLabel, LabelFacts>;

FactsByLabel facts_of(const io::LabelVolume& volume, const std::set<RawLabel>& wanted,
                      const VerifyTask& task, int readers) {
  const int scanners = scanner_count(volume, task.threads, task.memory_bytes);
  const io::LabelTable table = collect_labels(volume, std::max(scanners, readers));
  const io::DenseVolume labels(volume, table);
  const VolumeFindings found =
      look_at_volume(labels, TileGrid(volume.info().shape, {1, 1, 1}), task, {});
  FactsByLabel out;
  for (const RawLabel label : wanted) {
    const Label dense = table.find(label);
    if (dense == kExterior) continue;
    out[label] = {found.voxels[dense].voxels, found.betti[dense]};
  }
  return out;
}

std::optional<LabelFacts> fact(const FactsByLabel& facts, RawLabel label) {
  const auto found = facts.find(label);
  return found == facts.end() ? std::nullopt : std::optional(found->second);
}

std::vector<ContactChange> contact_changes(const io::LabelVolume& before,
                                           const io::LabelVolume& after, int readers) {
  std::map<std::pair<RawLabel, RawLabel>, ContactChange> all;
  for (const LabelContact& c : label_contacts(before, readers)) {
    all[{c.first, c.second}] = {c.first, c.second, c.faces, {}};
  }
  for (const LabelContact& c : label_contacts(after, readers)) {
    ContactChange& change = all[{c.first, c.second}];
    change.first = c.first;
    change.second = c.second;
    change.after = c.faces;
  }
  std::vector<ContactChange> out;
  for (const auto& [pair, change] : all) {
    if (change.before != change.after) out.push_back(change);
  }
  return out;
}

/// Sorts labels and contacts by labels as signed numbers.
void sort_signed(VolumeDelta& delta) {
  const auto number = [](RawLabel label) { return static_cast<std::int64_t>(label); };
  std::sort(delta.labels.begin(), delta.labels.end(),
            [&](const auto& a, const auto& b) { return number(a.label) < number(b.label); });
  for (ContactChange& c : delta.contacts) {
    if (number(c.second) < number(c.first)) std::swap(c.first, c.second);
  }
  std::sort(delta.contacts.begin(), delta.contacts.end(), [&](const auto& a, const auto& b) {
    return std::pair(number(a.first), number(a.second)) <
           std::pair(number(b.first), number(b.second));
  });
}

io::Json facts_json(const std::optional<LabelFacts>& facts) {
  if (!facts) return nullptr;
  return {{"voxels", facts->voxels},
          {"betti_closed", report::betti_json(facts->betti.closed)},
          {"betti_open", report::betti_json(facts->betti.open)}};
}

io::Json faces_json(const std::array<std::uint64_t, 3>& faces) {
  return {faces[0], faces[1], faces[2]};
}

io::Json size_json(const MeshSize& size) {
  return {{"vertices", size.vertices}, {"tets", size.tets}};
}

}  // namespace

VolumeDelta delta_of(const io::LabelVolume& before, const io::LabelVolume& after,
                     const VerifyTask& task, int readers) {
  VolumeDelta out;
  out.labels_signed = has_signed_labels(after.info());
  const std::set<RawLabel> touched = compare(before, after, readers, out);
  if (touched.empty()) return out;
  const FactsByLabel was = facts_of(before, touched, task, readers);
  const FactsByLabel is = facts_of(after, touched, task, readers);
  for (const RawLabel label : touched) {
    out.labels.push_back({label, fact(was, label), fact(is, label)});
  }
  out.contacts = contact_changes(before, after, readers);
  const Index3 first = first_number(after.info());
  out.box = {out.box.lo + first, out.box.hi + first};
  if (out.labels_signed) sort_signed(out);
  return out;
}

io::Json delta_json(const VolumeDelta& delta, const std::optional<MeshSize>& before,
                    const MeshSize& after) {
  io::Json out = io::Json::object();
  out["voxels_changed"] = delta.voxels;
  out["renumbered"] = delta.is_renumbered;
  out["box"] = nullptr;
  if (delta.voxels > 0) {
    out["box"] = {{"from", report::index_json(delta.box.lo)},
                  {"to", report::index_json(delta.box.hi)}};
  }
  out["labels"] = io::Json::array();
  for (const LabelChange& change : delta.labels) {
    out["labels"].push_back({{"label", report::label_json(change.label, delta.labels_signed)},
                             {"before", facts_json(change.before)},
                             {"after", facts_json(change.after)}});
  }
  out["contacts"] = io::Json::array();
  for (const ContactChange& change : delta.contacts) {
    out["contacts"].push_back({{"labels",
                                {report::label_json(change.first, delta.labels_signed),
                                 report::label_json(change.second, delta.labels_signed)}},
                               {"faces_before", faces_json(change.before)},
                               {"faces_after", faces_json(change.after)}});
  }
  out["mesh"] = {{"before", nullptr}, {"after", size_json(after)}};
  if (before) out["mesh"]["before"] = size_json(*before);
  return out;
}

}  // namespace mw::engine
