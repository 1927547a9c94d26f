// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every target by its function; what each checks is said where it is defined.
#pragma once

#include <vector>

#include "tests/fuzz/target.h"

namespace mw::fuzz {

/// Those of volumes.cpp.
[[nodiscard]] std::vector<Target> volume_targets();
// mesh_files.cpp
void fuzz_vtu(Bytes bytes);
void fuzz_medit(Bytes bytes);
void fuzz_gmsh(Bytes bytes);
void fuzz_pvtu(Bytes bytes);
// names.cpp
void fuzz_names(Bytes bytes);
void fuzz_label_table(Bytes bytes);
// options.cpp
void fuzz_values(Bytes bytes);
void fuzz_config(Bytes bytes);
// codecs.cpp
void fuzz_codecs(Bytes bytes);
void fuzz_segmentation(Bytes bytes);
// store.cpp
void fuzz_block(Bytes bytes);
void fuzz_journal(Bytes bytes);
// mesh_steps.cpp
void fuzz_collapse(Bytes bytes);
void fuzz_simplify(Bytes bytes);
void fuzz_optimise(Bytes bytes);
// coarsening.cpp
void fuzz_coarsen(Bytes bytes);
// masks.cpp
void fuzz_masks(Bytes bytes);
void fuzz_layers(Bytes bytes);
void fuzz_scores(Bytes bytes);
// dicom.cpp
void fuzz_dicom(Bytes bytes);
void fuzz_packed_frame(Bytes bytes);
void fuzz_slice_grid(Bytes bytes);
// remote.cpp
void fuzz_http_headers(Bytes bytes);
void fuzz_addresses(Bytes bytes);
void fuzz_http(Bytes bytes);
void fuzz_remote(Bytes bytes);
void fuzz_cache(Bytes bytes);

}  // namespace mw::fuzz
