// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts, and the 48 symmetries of a cube as far as the box has them.
#include "kernels/audit/partition/placement.h"

#include <algorithm>

namespace mw::audit {
namespace {

/// Returns the voxels of an axis whose distance from the middle, in whole voxels, is a multiple of
/// step.
std::vector<std::int64_t> samples_along(std::int64_t voxels, std::int64_t step) {
  std::vector<std::int64_t> out;
  for (std::int64_t i = 0; i < voxels; ++i) {
    if (std::abs(2 * i + 1 - voxels) / 2 % step == 0) out.push_back(i);
  }
  return out;
}

/// Compares a row with as many labels.
std::uint64_t count_equal(std::span<const Label> row, const Label* labels) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < row.size(); ++i) out += row[i] == labels[i] ? 1U : 0U;
  return out;
}

}  // namespace

WantedCentres wanted_centres(std::size_t label_count, const KeptLabels& kept,
                             const KeptLabels& partial) {
  WantedCentres out;
  for (Label l = 0; l < label_count; ++l) {
    out.push_back(is_partial(partial, l) ? kUnknown : keeps(kept, l) ? l : kLeftOut);
  }
  return out;
}

PlaceTally tally_places(std::span<const Label> labels, std::span<const Label> centres,
                        const WantedCentres& wanted) {
  PlaceTally out;
  std::vector<std::array<Label, 2>> missed;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Label label = wanted[labels[i]];
    if (label == kUnknown) continue;
    ++out.voxels;
    if (label == centres[i]) {
      ++out.hits;
    } else if (label < wanted.size() && centres[i] < wanted.size()) {
      missed.push_back({label, centres[i]});
    }
  }
  std::sort(missed.begin(), missed.end());
  for (const auto& [label, found] : missed) {
    const bool is_new =
        out.missed.empty() || out.missed.back().label != label || out.missed.back().found != found;
    if (is_new) out.missed.push_back({label, found, 0});
    ++out.missed.back().voxels;
  }
  return out;
}

PlaceSamples::PlaceSamples(Index3 shape) : shape_(shape) {
  for (std::int64_t step = 1; step == 1 || counts().product() > kMostSamples; ++step) {
    at_ = {samples_along(shape.x, step), samples_along(shape.y, step),
           samples_along(shape.z, step)};
  }
  wanted_.assign(static_cast<std::size_t>(counts().product()), kUnknown);
  centres_.assign(wanted_.size(), kLeftOut);
}

Index3 PlaceSamples::counts() const {
  const auto along = [this](std::size_t axis) {
    return static_cast<std::int64_t>(at_[axis].size());
  };
  return {along(0), along(1), along(2)};
}

void PlaceSamples::put(const Box3& box, std::span<const Label> labels,
                       std::span<const Label> centres, const WantedCentres& wanted) {
  const auto from = [this](std::size_t axis, std::int64_t voxel) {
    return std::lower_bound(at_[axis].begin(), at_[axis].end(), voxel) - at_[axis].begin();
  };
  const Box3 mine{{from(0, box.lo.x), from(1, box.lo.y), from(2, box.lo.z)},
                  {from(0, box.hi.x), from(1, box.hi.y), from(2, box.hi.z)}};
  const Box3 all{{0, 0, 0}, counts()};
  for_each_index(mine, [&](Index3 i) {
    const auto voxel = static_cast<std::size_t>(
        box.offset({at_[0][static_cast<std::size_t>(i.x)], at_[1][static_cast<std::size_t>(i.y)],
                    at_[2][static_cast<std::size_t>(i.z)]}));
    const auto sample = static_cast<std::size_t>(all.offset(i));
    wanted_[sample] = wanted[labels[voxel]];
    centres_[sample] = centres[voxel];
  });
}

/// Turns samples so that their axis axes[k] lies along axis k, and counts those that are as wanted
/// for each way to turn axes over: bit k of the place in what it returns is that of axis k.  Ways
/// with fewer than `enough` have 0.
std::array<std::uint64_t, 8> PlaceSamples::equal_to(const std::vector<Label>& turned,
                                                    const Axes& axes, std::uint64_t enough) const {
  const Index3 n = counts();
  const std::array<std::int64_t, 3> strides{1, n.x, n.x * n.y};
  const auto step = static_cast<std::size_t>(strides[axes[0]]);
  std::array<std::uint64_t, 8> out{};
  unsigned open = 0xff;  // ways that may have enough, as bits
  std::vector<Label> row(static_cast<std::size_t>(n.x)), back(row);
  for (std::int64_t z = 0; z < n.z && open != 0; ++z) {
    for (std::int64_t y = 0; y < n.y; ++y) {
      const auto first = static_cast<std::size_t>(y * strides[axes[1]] + z * strides[axes[2]]);
      for (std::size_t x = 0; x < row.size(); ++x) row[x] = turned[first + x * step];
      std::reverse_copy(row.begin(), row.end(), back.begin());
      for (unsigned flips = 0; flips < 8; ++flips) {
        if ((open >> flips & 1U) == 0) continue;
        const std::int64_t y_to = (flips & 2U) != 0 ? n.y - 1 - y : y;
        const std::int64_t z_to = (flips & 4U) != 0 ? n.z - 1 - z : z;
        out[flips] +=
            count_equal((flips & 1U) != 0 ? back : row, wanted_.data() + (z_to * n.y + y_to) * n.x);
      }
    }
    const auto to_come = static_cast<std::uint64_t>((n.z - 1 - z) * n.y * n.x);
    for (unsigned flips = 0; flips < 8; ++flips) {
      if (out[flips] + to_come >= enough) continue;
      out[flips] = 0;
      open &= ~(1U << flips);
    }
  }
  return out;
}

bool PlaceSamples::Hits::is_turned() const {
  if (otherwise <= as_it_lies) return false;
  const std::uint64_t more = otherwise - as_it_lies;
  return more * more > 9 * changed;
}

PlaceSamples::Hits PlaceSamples::count() const {
  const std::array<std::int64_t, 3> voxels{shape_.x, shape_.y, shape_.z};
  Axes axes{0, 1, 2};
  Hits most{.as_it_lies = count_equal(wanted_, centres_.data())};
  do {
    const bool fits = voxels[axes[0]] == voxels[0] && voxels[axes[1]] == voxels[1] &&
                      voxels[axes[2]] == voxels[2];
    if (!fits) continue;
    const auto hits = equal_to(centres_, axes, most.as_it_lies);
    const bool is_first = std::is_sorted(axes.begin(), axes.end());
    // What a symmetry changes matters only where the mesh would be better off.
    const bool is_better = *std::max_element(hits.begin(), hits.end()) > most.as_it_lies;
    const auto same = is_better ? equal_to(wanted_, axes, 0) : hits;
    for (std::size_t flips = 0; flips < hits.size(); ++flips) {
      const Hits here{most.as_it_lies, hits[flips], wanted_.size() - same[flips]};
      if ((is_first && flips == 0) || here.is_turned() < most.is_turned()) continue;
      if (here.is_turned() > most.is_turned() || here.otherwise > most.otherwise) most = here;
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return most;
}

void ExchangedLabels::add(Label one, Label other, std::uint64_t voxels, std::uint64_t exchanged) {
  if (2 * exchanged <= voxels) return;
  found_.add([&] { return label_text(one, names_) + " and " + label_text(other, names_); });
}

Check judge_places(const PlaceTally& all, const PlaceSamples& samples,
                   const ExchangedLabels& exchanged) {
  const PlaceSamples::Hits hits = samples.count();
  const auto share = [](std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 100.0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
  };
  std::string detail = number(share(all.hits, all.voxels)) + " % of " + std::to_string(all.voxels) +
                       " voxels have their centres in tets of their label";
  if (hits.is_turned()) {
    detail += "; mirrored or turned " + number(share(hits.otherwise, samples.size())) +
              " % of the samples have, and as it lies " +
              number(share(hits.as_it_lies, samples.size()));
  }
  if (exchanged.found().count() > 0) detail += "; " + exchanged.found().text();
  const bool has_most = all.voxels == 0 || 2 * all.hits > all.voxels;
  return {"P4 place", has_most && !hits.is_turned() && exchanged.found().count() == 0, detail};
}

}  // namespace mw::audit
