// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is written comes back; ends and errors are told apart.  Calls that do less than asked for
// are made by tests/faults/io_errors.py.
#include "io/file/file_descriptor.h"

#include <fcntl.h>

#include <cerrno>

#include "tests/io/test_files.h"

namespace mw::io {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

TEST(WholeCalls, WhatIsWrittenComesBack) {
  const TempDir dir;
  const auto path = dir.file("f", "abc");
  const FileDescriptor file(::open(path.c_str(), O_RDWR));
  const Transfer wrote = write_all(file.get(), 2, bytes_of("XYZ"));
  EXPECT_EQ(wrote.bytes, 3U);
  EXPECT_EQ(wrote.error, 0);
  EXPECT_EQ(content_of(path), "abXYZ");
  std::string back(3, '.');
  const Transfer read = read_all(file.get(), 1, std::as_writable_bytes(std::span(back)));
  EXPECT_EQ(read.bytes, 3U);
  EXPECT_EQ(read.error, 0);
  EXPECT_EQ(back, "bXY");
}

TEST(WholeCalls, TheEndOfAFileIsNoError) {
  const TempDir dir;
  const FileDescriptor file(::open(dir.file("f", "abc").c_str(), O_RDONLY));
  std::string back(5, '.');
  const Transfer read = read_all(file.get(), 2, std::as_writable_bytes(std::span(back)));
  EXPECT_EQ(read.bytes, 1U);
  EXPECT_EQ(read.error, 0);
  EXPECT_EQ(back, "c....");
}

TEST(WholeCalls, ErrorsAreTold) {
  const TempDir dir;
  const auto path = dir.file("f", "abc");
  const FileDescriptor reading(::open(path.c_str(), O_RDONLY));
  const FileDescriptor writing(::open(path.c_str(), O_WRONLY));
  std::string back(2, '.');
  EXPECT_EQ(write_all(reading.get(), 0, bytes_of("x")).error, EBADF);
  EXPECT_EQ(read_all(writing.get(), 0, std::as_writable_bytes(std::span(back))).error, EBADF);
  EXPECT_EQ(content_of(path), "abc");
}

}  // namespace
}  // namespace mw::io
