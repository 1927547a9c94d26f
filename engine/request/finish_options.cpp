// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/request/finish_options.h"

#include "engine/request/shared_options.h"
#include "engine/request/values.h"
#include "engine/sample/sample_text.h"
#include "engine/settings/size_text.h"

namespace mw::request {

void add_connect_options(OptionSet& options, engine::ConnectOptions& connect) {
  options.add({.name = "parts",
               .value = "all|largest|N",
               .help = "parts that are written; N: those of at least N tets",
               .group = kOutputGroup,
               .kind = ValueKind::kNumberOrText,
               .fallback = "all",
               .listed = Listed::kInHelpAll,
               .assign = into(connect.parts, engine::parse_parts)});
  options.add({.name = "split",
               .value = "A|B,...",
               .help = "doubles the vertices of interfaces, so that they open; *: of all",
               .group = kOutputGroup,
               .listed = Listed::kInHelpAll,
               .has_labels = true,
               .assign = into(connect.split, engine::parse_split)});
  options.add({.name = "cohesive",
               .value = "A|B,...",
               .help = "--split, with wedges of no thickness in between, from A to B",
               .group = kOutputGroup,
               .listed = Listed::kInHelpAll,
               .has_labels = true,
               .assign = into(connect.cohesive, engine::parse_cohesive)});
  options.add(
      switch_of(connect.open_hinges,
                {.name = "open-hinges",
                 .help = "doubles the vertices at which parts hang, so that they come apart",
                 .group = kOutputGroup,
                 .listed = Listed::kInHelpAll}));
}

void add_format_options(OptionSet& options, io::MeshExtras& extras, Listed listed) {
  options.add({.name = "ascii",
               .help = "a .msh as text instead of binary",
               .group = kOutputGroup,
               .kind = ValueKind::kSwitch,
               .fallback = "false",
               .calls = kWriting,
               .listed = listed,
               .assign = into(extras.encoding, parse_ascii)});
  options.add({.name = "materials",
               .value = "NAME=N[:LO:HI]",
               .help = "N sets of elements by equal ranges of the values NAME, with a table",
               .group = kOutputGroup,
               .calls = kWriting,
               .listed = listed,
               .assign = into(extras.materials, engine::parse_materials)});
  options.add({.name = "deck",
               .value = "JOB",
               .help = "static: a job that pulls; periodic, conduction: of a cell",
               .group = kOutputGroup,
               .fallback = "none",
               .choices = kDecks,
               .calls = kWriting,
               .listed = listed,
               .assign = into(extras.deck, parse_deck)});
  options.add({.name = "pairs",
               .value = "FILE",
               .help = "nodes of --periodic faces: .csv, or equations in .inp",
               .group = kOutputGroup,
               .calls = kWriting,
               .listed = listed,
               .assign = into(extras.pairs)});
}

void add_sample_option(OptionSet& options, std::vector<engine::SampleImage>& samples) {
  options.add({.name = "sample",
               .value = "NAME=FILE[:mean]",
               .help = "an image's mean, min, max or mode in each tet, repeatable",
               .group = kOutputGroup,
               .listed = Listed::kInHelpAll,
               .repeats = true,
               .assign = into(samples, engine::parse_samples)});
}

}  // namespace mw::request
