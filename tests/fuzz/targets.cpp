// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The list of targets.
#include "tests/fuzz/all_targets.h"

#include <array>

namespace mw::fuzz {
namespace {

constexpr std::array kTargets{
    Target{"npy", fuzz_npy},
    Target{"nrrd", fuzz_nrrd},
    Target{"nifti", fuzz_nifti},
    Target{"metaimage", fuzz_metaimage},
    Target{"tiff", fuzz_tiff},
    Target{"png", fuzz_png},
    Target{"raw", fuzz_raw},
    Target{"gzip", fuzz_gzip},
    Target{"zarr", fuzz_zarr},
    Target{"n5", fuzz_n5},
    Target{"precomputed", fuzz_precomputed},
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
};

}  // namespace

std::span<const Target> targets() {
  return kTargets;
}

}  // namespace mw::fuzz
