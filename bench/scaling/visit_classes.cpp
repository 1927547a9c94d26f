// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/visit_classes.h"

#include <iterator>
#include <random>
#include <string>

#include "kernels/core/error.h"

namespace mw::bench {

VisitClasses::VisitClasses(const RunFlow& flow, const std::vector<double>& seconds) {
  for (std::uint32_t w = 0; w < flow.windows(); ++w) {
    durations_[{flow.march_of(w), flow.fresh_eighths(w)}].push_back(seconds[w]);
  }
}

const std::vector<double>& VisitClasses::durations(const Class& wanted) const {
  auto found = durations_.upper_bound(wanted);
  const bool has_smaller =
      found != durations_.begin() && std::prev(found)->first.first == wanted.first;
  if (has_smaller) --found;
  if (found == durations_.end() || found->first.first != wanted.first) {
    throw Error(ErrorKind::kUsage,
                "the trace has no march " + std::to_string(wanted.first) + " to draw from");
  }
  return found->second;
}

std::vector<double> VisitClasses::draw(const RunFlow& flow, std::uint64_t seed) const {
  std::mt19937_64 random(seed);  // the standard says which numbers it gives
  std::vector<double> out(flow.windows());
  for (std::uint32_t w = 0; w < flow.windows(); ++w) {
    const auto& of_class = durations({flow.march_of(w), flow.fresh_eighths(w)});
    out[w] = of_class[random() % of_class.size()];
  }
  return out;
}

std::vector<double> traced_seconds(const RunFlow& flow, const std::vector<MarchTrace>& trace) {
  for (std::uint32_t march = 0; march < trace.size(); ++march) {
    if (!(trace[march].windows == flow.layout().grid(march).windows())) {
      throw Error(ErrorKind::kInput,
                  "march " + std::to_string(march) + " of the trace does not fit the one before");
    }
  }
  std::vector<double> out(flow.windows());
  for (std::uint32_t w = 0; w < flow.windows(); ++w) {
    const engine::WindowKey key = flow.key(w);
    const MarchTrace& march = trace[key.march];
    out[w] = march.seconds[raster(key.window, march.windows)];
  }
  return out;
}

}  // namespace mw::bench
