// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Errors that a test waits for.
#pragma once

#include "kernels/core/error.h"
#include "tests/testing.h"

namespace mw {

/// Runs action and checks the kind of its Error and that its message has every piece.
template <class Action>
void expect_error(ErrorKind kind, const std::vector<std::string>& pieces, Action action) {
  try {
    action();
    ADD_FAILURE() << "no error; expected one about " << testing::PrintToString(pieces);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    for (const std::string& piece : pieces) {
      EXPECT_NE(std::string(error.what()).find(piece), std::string::npos)
          << error.what() << "\nlacks " << piece;
    }
  }
}

}  // namespace mw
