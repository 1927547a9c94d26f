// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The list of targets.
#include "tests/fuzz/all_targets.h"

#include <array>

namespace mw::fuzz {
namespace {

/// Those that are no volumes.
constexpr std::array kTargets{
    Target{"vtu", fuzz_vtu},
    Target{"medit", fuzz_medit},
    Target{"gmsh", fuzz_gmsh},
    Target{"pvtu", fuzz_pvtu},
    Target{"names", fuzz_names},
    Target{"label_table", fuzz_label_table},
    Target{"values", fuzz_values},
    Target{"config", fuzz_config},
    Target{"codecs", fuzz_codecs},
    Target{"segmentation", fuzz_segmentation},
    Target{"block", fuzz_block},
    Target{"journal", fuzz_journal},
    Target{"collapse", fuzz_collapse, 500},
    Target{"simplify", fuzz_simplify, 100},
    Target{"optimise", fuzz_optimise, 100},
    Target{"coarsen", fuzz_coarsen, 100},
    Target{"masks", fuzz_masks, 500},
    Target{"layers", fuzz_layers},
    Target{"scores", fuzz_scores},
    Target{"dicom", fuzz_dicom, 40},
    Target{"packed_frame", fuzz_packed_frame},
    Target{"slice_grid", fuzz_slice_grid},
    Target{"http_headers", fuzz_http_headers},
    Target{"addresses", fuzz_addresses},
    Target{"http", fuzz_http, 500},
    Target{"remote", fuzz_remote, 1000},
    Target{"cache", fuzz_cache},
};

}  // namespace

std::span<const Target> targets() {
  static const std::vector<Target> all = [] {
    std::vector<Target> targets = volume_targets();
    targets.insert(targets.end(), kTargets.begin(), kTargets.end());
    return targets;
  }();
  return all;
}

}  // namespace mw::fuzz
