// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Work in a process of its own: its answer, its errors, and the ways in which it dies.
#include "io/file/wall/apart.h"

#include <signal.h>
#include <unistd.h>

#include <new>
#include <stdexcept>

#include "tests/io/test_files.h"

namespace mw::io {
namespace {

ApartAnswer die(const std::function<void()>& work, const ApartLimits& limits = {}) {
  return run_apart(limits, [&] {
    work();
    return std::string("alive");
  });
}

TEST(Apart, AnswersOfAnyBytes) {
  std::string all(300'000, '\0');
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<char>(i * 7);
  for (const std::string& bytes : {std::string(), std::string("\0a", 2), all}) {
    const ApartAnswer answer = run_apart({}, [&] { return bytes; });
    EXPECT_EQ(answer.bytes, bytes);
    EXPECT_EQ(answer.death, "");
  }
}

TEST(Apart, ErrorsComeBack) {
  expect_error(ErrorKind::kInput, {"file: field: reason; way out"}, [] {
    static_cast<void>(die([] { throw Error(ErrorKind::kInput, "file: field: reason; way out"); }));
  });
  expect_error(ErrorKind::kResource, {"disk"},
               [] { static_cast<void>(die([] { throw Error(ErrorKind::kResource, "disk"); })); });
}

TEST(Apart, CrashesStayThere) {
  const ApartAnswer killed = die([] { ::raise(SIGSEGV); });
  EXPECT_FALSE(killed.bytes);
  EXPECT_EQ(killed.death, "it crashed (signal 11)");
  EXPECT_EQ(die([] { throw std::runtime_error("no Error"); }).death, "it crashed");
  EXPECT_EQ(die([] { throw std::bad_alloc(); }).death, "it wanted too much memory");
}

/// A terminal and a batch system signal the whole group; what is to be done is the parent's
/// decision.
TEST(Apart, SignalsToTheGroupAreNoCrash) {
  const ApartAnswer answer = run_apart({}, [] {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) ::raise(signal);
    return std::string("answer");
  });
  EXPECT_EQ(answer.bytes, "answer");
}

/// A host program may ignore the ends of its children, and then the system tells nothing of them.
TEST(Apart, EndsAreKnownWhereTheSystemDoesNotTellThem) {
  const auto before = ::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(die([] {}).bytes, "alive");
  EXPECT_EQ(die([] { ::raise(SIGSEGV); }).death, "it crashed");
  EXPECT_EQ(die([] { ::_exit(0); }).death, "it crashed");
  EXPECT_EQ(die([] { throw std::runtime_error("no Error"); }).death, "it crashed");
  EXPECT_EQ(die([] { throw std::bad_alloc(); }).death, "it wanted too much memory");
  expect_error(ErrorKind::kInput, {"file: field"}, [] {
    static_cast<void>(die([] { throw Error(ErrorKind::kInput, "file: field"); }));
  });
  ::signal(SIGCHLD, before);
}

TEST(Apart, LimitsHold) {
  ApartLimits limits;
  limits.cpu_seconds = 1;
  const auto never_end = [] {
    const volatile bool forever = true;
    while (forever) {
    }
  };
  EXPECT_EQ(die(never_end, limits).death, "it found no end");
  limits.answer_bytes = 5;
  EXPECT_EQ(run_apart(limits, [] { return std::string(5, 'a'); }).bytes, "aaaaa");
  EXPECT_EQ(run_apart(limits, [] { return std::string(6, 'a'); }).death, "its answer has no end");
}

/// Whether a mapping beyond the limit fails, whatever the allocator makes of that.
TEST(Apart, MemoryIsLimited) {
  ApartLimits limits;
  limits.memory_bytes = 64 << 20;
  const auto take = [](std::size_t bytes) {
    return [bytes] {
      std::string block(bytes, 'x');
      return std::string(1, block[bytes / 2]);
    };
  };
  EXPECT_EQ(run_apart(limits, take(1 << 20)).bytes, "x");
  EXPECT_FALSE(run_apart(limits, take(256 << 20)).bytes);
}

}  // namespace
}  // namespace mw::io
