// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A place on disk for one test.
#pragma once

#include "tests/temp_folder.h"
#include "tests/testing.h"

namespace mw::engine::test {

/// A test with an empty folder that goes with it.
class FolderTest : public testing::Test {
 protected:
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  mw::test::TempFolder folder_;
};

}  // namespace mw::engine::test
