// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lets libpng write into memory, and hands the bytes from there to the caller's function.
#include "io/picture/png_writer.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <string>
#include <vector>

#include "kernels/core/error.h"

namespace mw::io {
namespace {

/// What libpng wrote, and why it gave up.
struct Buffer {
  std::vector<std::byte> bytes;
  std::string complaint;
};

/// libpng leaves by longjmp, so that nothing in the frames between may need a destructor.
[[noreturn]] void leave(png_structp png, png_const_charp complaint) {
  static_cast<Buffer*>(png_get_error_ptr(png))->complaint = complaint;
  png_longjmp(png, 1);
}

void keep_silent(png_structp /*png*/, png_const_charp /*warning*/) {}

void keep_bytes(png_structp png, png_bytep bytes, std::size_t count) {
  std::vector<std::byte>& out = static_cast<Buffer*>(png_get_io_ptr(png))->bytes;
  const auto* const from = reinterpret_cast<const std::byte*>(bytes);
  out.insert(out.end(), from, from + count);
}

void flush_nothing(png_structp /*png*/) {}

/// Lays the pixels over white.
void make_opaque(std::span<const std::uint8_t> rgba, std::vector<std::uint8_t>& rgb) {
  rgb.clear();
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const std::uint32_t alpha = rgba[i + 3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t mixed = rgba[i + k] * alpha + 255 * (255 - alpha);
      rgb.push_back(static_cast<std::uint8_t>((mixed + 127) / 255));
    }
  }
}

}  // namespace

struct PngWriter::Library {
  Library() = default;
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { png_destroy_write_struct(&png, &info); }

  /// Runs calls of libpng; false when it gave up.
  template <typename Calls>
  bool run(Calls calls) {
    // NOLINTNEXTLINE(cert-err52-cpp): libpng knows no other way.
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    calls();
    return true;
  }
  template <typename Calls>
  void require(Calls calls) {
    if (!run(calls)) throw Error(ErrorKind::kInternal, "libpng: " + buffer.complaint);
  }

  Buffer buffer;
  png_structp png = nullptr;
  png_infop info = nullptr;
  bool transparent = false;
  std::vector<std::uint8_t> rgb;  ///< a row
};

PngWriter::PngWriter(std::uint32_t width, std::uint32_t height, bool transparent, TakeBytes take)
    : library_(std::make_unique<Library>()), take_(std::move(take)) {
  Library& library = *library_;
  library.transparent = transparent;
  library.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &library.buffer, leave, keep_silent);
  if (library.png != nullptr) library.info = png_create_info_struct(library.png);
  if (library.info == nullptr) throw Error(ErrorKind::kInternal, "libpng does not start");
  std::array<char, 9> key{"Software"};
  std::array<char, 7> program{"mwmesh"};
  png_text written_by{};
  written_by.compression = PNG_TEXT_COMPRESSION_NONE;
  written_by.key = key.data();
  written_by.text = program.data();
  written_by.text_length = program.size() - 1;
  library.require([&] {
    png_set_write_fn(library.png, &library.buffer, keep_bytes, flush_nothing);
    png_set_compression_level(library.png, 9);
    png_set_IHDR(library.png, library.info, width, height, 8,
                 transparent ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_text(library.png, library.info, &written_by, 1);
    png_set_sRGB(library.png, library.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(library.png, library.info);
  });
  pass_on();
}

PngWriter::~PngWriter() = default;

void PngWriter::write_row(std::span<const std::uint8_t> rgba) {
  Library& library = *library_;
  const std::uint8_t* row = rgba.data();
  if (!library.transparent) {
    make_opaque(rgba, library.rgb);
    row = library.rgb.data();
  }
  library.require([&] { png_write_row(library.png, row); });
  pass_on();
}

void PngWriter::finish() {
  library_->require([&] { png_write_end(library_->png, nullptr); });
  pass_on();
}

void PngWriter::pass_on() {
  if (!library_->buffer.bytes.empty()) take_(library_->buffer.bytes);
  library_->buffer.bytes.clear();
}

}  // namespace mw::io
