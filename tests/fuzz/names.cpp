// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tables of names of labels.
#include "io/names/header_names.h"
#include "io/names/label_names.h"
#include "io/names/read_names.h"
#include "tests/fuzz/all_targets.h"

namespace mw::fuzz {
namespace {

void check(const io::LabelNames& names) {
  const io::LabelName* before = nullptr;
  for (const io::LabelName& row : names.rows()) {
    require(before == nullptr || before->label < row.label, "rows are ascending");
    require(io::clean_name(row.name) == row.name, "names are clean");
    require(!row.name.empty() || row.colour, "a row says something");
    before = &row;
  }
}

}  // namespace

void fuzz_names(Bytes bytes) {
  ends_well([&] { check(io::parse_names(text_of(bytes), "fuzzed names")); });
}

void fuzz_label_table(Bytes bytes) {
  check(io::parse_label_table(text_of(bytes)));
}

}  // namespace mw::fuzz
