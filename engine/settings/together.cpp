// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The table of what does not go together, in the order in which it is looked at.
#include "engine/settings/together.h"

#include <array>

#include "io/file/errors.h"

namespace mw::engine {
namespace {

enum class Bond { kNeeds, kNotWith };
using enum Bond;

struct Rule {
  bool Asked::*one;
  Bond bond;
  bool Asked::*other;
  const char* told;  ///< what contradicts what, and the way out
};

constexpr std::array kRules{
    Rule{&Asked::keep_bytes, kNeeds, &Asked::keep,
         "--keep-bytes: is the size of a folder, name it with --keep"},
    Rule{&Asked::changed, kNeeds, &Asked::update,
         "--changed: says what changed since a run, give --from as well"},
    Rule{&Asked::delta, kNeeds, &Asked::update,
         "--delta: says what changed since a run, give --from as well"},
    Rule{&Asked::changed, kNotWith, &Asked::object,
         "--changed: says nothing where --object finds the box anew, leave it out"},
    Rule{&Asked::keep, kNeeds, &Asked::colour,
         "--keep: needs --order colour: in raster order an edit changes what all later windows "
         "see, so nothing could be used again"},
    Rule{&Asked::keep, kNotWith, &Asked::count,
         "--count: looks at the whole volume, so that an edit anywhere could change sizes "
         "everywhere; with --keep give --size instead"},
    Rule{&Asked::update, kNotWith, &Asked::many,
         "--from: works in one process only, run mwmesh without mpirun"},
    Rule{&Asked::merge, kNotWith, &Asked::scores,
         "--merge: merged labels have no probabilities or distances; merge these (the sum of "
         "probabilities, the least distance) before they are meshed"},
    Rule{&Asked::interpolate, kNotWith, &Asked::scores,
         "--interpolate-slices: thin slices have no probabilities or distances; interpolate these "
         "between slices before they are meshed, or mesh a volume of labels"},
    Rule{
        &Asked::interpolate, kNotWith, &Asked::periodic,
        "--interpolate-slices: nothing is interpolated from the last slice to the first, so a cell "
        "would not repeat itself; leave out --periodic, or this"},
    Rule{&Asked::weld, kNotWith, &Asked::scores,
         "--weld: voxels that it fills have no probabilities or distances; mesh a volume of "
         "labels, or without it"},
    Rule{&Asked::keep, kNotWith, &Asked::scores,
         "--keep: what is kept is known by its labels alone, and interfaces depend on "
         "probabilities and distances, too; mesh without it, or a volume of labels"},
    Rule{&Asked::many, kNotWith, &Asked::scores,
         "--values: probabilities and distances are meshed in one process only, run mwmesh without "
         "mpirun"},
    Rule{&Asked::curves, kNotWith, &Asked::doubles,
         "--element tet10-curved: not with --split, --cohesive or --open-hinges, which double "
         "vertices; tet10 is"},
    Rule{&Asked::pairs, kNeeds, &Asked::periodic,
         "--pairs: only a cell that repeats itself has some, give --periodic"},
    Rule{&Asked::pairs, kNotWith, &Asked::doubles,
         "--pairs: are not known where vertices are doubled; leave out --split, --cohesive and "
         "--open-hinges"},
    Rule{
        &Asked::cell_job, kNeeds, &Asked::whole_cell,
        "--deck periodic, conduction: is a job of a cell that repeats itself, give --periodic xyz"},
    Rule{&Asked::cell_job, kNotWith, &Asked::doubles,
         "--deck periodic, conduction: pairs of nodes are not known where vertices are doubled; "
         "leave out --split, --cohesive and --open-hinges"},
};

}  // namespace

void check_together(const Asked& asked) {
  for (const Rule& rule : kRules) {
    const bool has_other = asked.*rule.other;
    if (asked.*rule.one && has_other == (rule.bond == kNotWith)) io::fail_usage(rule.told);
  }
}

}  // namespace mw::engine
