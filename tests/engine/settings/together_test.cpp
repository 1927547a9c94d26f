// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What does not go together, and what does.
#include "engine/settings/together.h"

#include <gtest/gtest.h>

#include <string>

#include "kernels/core/error.h"

namespace mw::engine {
namespace {

/// Returns what is said against it; empty where nothing is.
std::string refusal(const Asked& asked) {
  try {
    check_together(asked);
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    return error.what();
  }
}

TEST(Together, IsRefusedWhereItContradictsItself) {
  struct Row {
    Asked asked;
    const char* begin;
  };
  const Row rows[] = {
      {{.keep_bytes = true}, "--keep-bytes:"},
      {{.keep = true}, "--keep: needs --order colour"},
      {{.keep = true, .colour = true, .count = true}, "--count:"},
      {{.keep = true, .update = true, .colour = true, .many = true}, "--from:"},
      {{.changed = true}, "--changed: says what"},
      {{.delta = true}, "--delta:"},
      {{.update = true, .changed = true, .object = true}, "--changed: says nothing"},
      {{.scores = true, .merge = true}, "--merge:"},
      {{.scores = true, .interpolate = true}, "--interpolate-slices: thin"},
      {{.periodic = true, .interpolate = true}, "--interpolate-slices: nothing"},
      {{.scores = true, .weld = true}, "--weld:"},
      {{.keep = true, .colour = true, .scores = true}, "--keep:"},
      {{.many = true, .scores = true}, "--values:"},
      {{.curves = true, .doubles = true}, "--element tet10-curved:"},
      {{.pairs = true}, "--pairs: only"},
      {{.periodic = true, .doubles = true, .pairs = true}, "--pairs: are"},
      {{.periodic = true, .cell_job = true}, "--deck periodic, conduction: is a job"},
      {{.whole_cell = true, .doubles = true, .cell_job = true},
       "--deck periodic, conduction: pairs"},
  };
  for (const Row& row : rows) EXPECT_EQ(refusal(row.asked).rfind(row.begin, 0), 0U) << row.begin;
}

TEST(Together, IsAllowedWhereNothingIsInTheWay) {
  for (const Asked& asked :
       {Asked{}, Asked{.keep = true, .keep_bytes = true, .colour = true, .many = true},
        Asked{.keep = true,
        .update = true,
        .changed = true,
        .delta = true,
        .colour = true,
        .periodic = true},
        Asked{.colour = true,
        .count = true,
        .many = true,
        .merge = true,
        .interpolate = true,
        .weld = true},
        Asked{.periodic = true, .many = true},
        Asked{.periodic = true, .count = true, .scores = true, .curves = true, .pairs = true},
        Asked{.periodic = true, .whole_cell = true, .cell_job = true},
        Asked{.merge = true, .weld = true, .doubles = true}}) {
    EXPECT_EQ(refusal(asked), "");
  }
}

}  // namespace
}  // namespace mw::engine
