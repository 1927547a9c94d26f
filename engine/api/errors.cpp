// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/api/errors.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "engine/api/asked.h"
#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::api {
namespace {

/// Is there before memory is out.
mw_error* no_memory() {
  static mw_error error{
      .kind = MW_RESOURCE,
      .text = "memory is out: give a smaller budget or a smaller volume, or free some",
      .option = ""};
  return &error;
}

mw_status kind_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kInternal:
      return MW_INTERNAL;
    case ErrorKind::kUsage:
      return MW_USAGE;
    case ErrorKind::kInput:
      return MW_INPUT;
    case ErrorKind::kResource:
      return MW_RESOURCE;
    case ErrorKind::kCheckFailed:
      return MW_CHECK_FAILED;
  }
  return MW_INTERNAL;
}

mw_error told(const Error& error) {
  return {.kind = kind_of(error.kind()),
          .text = in_words(error.what()),
          .option = option_of(error.what())};
}

/// Returns the exception that is being handled as an error.
mw_error current() {
  try {
    throw;
  } catch (const Error& error) {
    return told(error);
  } catch (const Cancelled& end) {
    return {.kind = MW_CANCELLED, .text = end.what(), .option = ""};
  } catch (const CallbackFailed& failure) {
    return {.kind = MW_CALLBACK, .text = failure.what(), .option = ""};
  } catch (const std::filesystem::filesystem_error& failure) {
    return told(io::file_failure(failure));
  } catch (const std::length_error&) {
    return {.kind = MW_RESOURCE,
            .text = "this is more than memory can hold: give a smaller volume",
            .option = ""};
  } catch (const std::bad_alloc&) {
    return *no_memory();
  } catch (const std::exception& other) {
    return {.kind = MW_INTERNAL, .text = other.what(), .option = ""};
  }
}

/// Exists before any call, so that no call has to make it.
const mw_error* const kNoMemory = no_memory();

}  // namespace

mw_status keep_error(mw_error** error) noexcept {
  try {
    auto kept = std::make_unique<mw_error>(current());
    const mw_status kind = kept->kind;
    if (error != nullptr) *error = kept.release();
    return kind;
  } catch (...) {
    if (error != nullptr) *error = no_memory();
    return MW_RESOURCE;
  }
}

char* text_of(const std::string& bytes) {
  auto* const out = static_cast<char*>(std::malloc(bytes.size() + 1));
  if (out == nullptr) throw std::bad_alloc();
  std::memcpy(out, bytes.c_str(), bytes.size() + 1);
  return out;
}

void require(const void* argument, const char* name) {
  if (argument == nullptr) io::fail_usage(std::string(name) + ": must not be NULL");
}

}  // namespace mw::api

mw_status mw_error_kind(const mw_error* error) {
  return error == nullptr ? MW_OK : error->kind;
}

const char* mw_error_text(const mw_error* error) {
  return error == nullptr ? "" : error->text.c_str();
}

const char* mw_error_option(const mw_error* error) {
  return error == nullptr ? "" : error->option.c_str();
}

void mw_error_free(mw_error* error) {
  if (error != mw::api::kNoMemory) delete error;
}

void mw_free(void* memory) {
  std::free(memory);
}
