// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// libFuzzer's side: one program, MW_FUZZ_TARGET says which target it runs.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/target.h"

namespace {

const mw::fuzz::Target& chosen() {
  const char* const name = std::getenv("MW_FUZZ_TARGET");  // NOLINT(concurrency-mt-unsafe)
  for (const mw::fuzz::Target& target : mw::fuzz::targets()) {
    if (name != nullptr && target.name == name) return target;
  }
  std::fputs("MW_FUZZ_TARGET is to be one of:\n", stderr);
  for (const mw::fuzz::Target& target : mw::fuzz::targets()) {
    std::fprintf(stderr, "%s\n", std::string(target.name).c_str());
  }
  std::exit(2);  // NOLINT(concurrency-mt-unsafe)
}

}  // namespace

/// What is thrown ends the program, which libFuzzer takes for a find.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const mw::fuzz::Target& target = chosen();
  target.run(std::as_bytes(std::span(data, size)));
  return 0;
}
