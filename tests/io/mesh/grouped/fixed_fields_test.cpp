// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Fields of numbers: their widths, their digits, and the point in any locale.
#include "io/mesh/grouped/fixed_fields.h"

#include <gmock/gmock.h>

#include <clocale>
#include <cstdlib>
#include <random>

#include "tests/io/test_files.h"

namespace mw::io {
namespace {

/// Sets the locale of C's functions while it lives, as a program does that has this as a library.
class CommaLocale {
 public:
  CommaLocale() : before_(std::setlocale(LC_ALL, nullptr)) {
    for (const char* const name : {"de_DE.UTF-8", "fr_FR.UTF-8", "nl_NL.UTF-8"}) {
      if (std::setlocale(LC_ALL, name) != nullptr) return;
    }
    const std::string folder = (dir_.path() / "de_DE.UTF-8").string();
    const std::string make = "localedef -i de_DE -f UTF-8 '" + folder + "' >/dev/null 2>&1";
    if (std::system(make.c_str()) != 0) return;
    ::setenv("LOCPATH", dir_.path().c_str(), 1);
    std::setlocale(LC_ALL, "de_DE.UTF-8");
    ::unsetenv("LOCPATH");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;
  ~CommaLocale() { std::setlocale(LC_ALL, before_.c_str()); }

 private:
  TempDir dir_;
  std::string before_;
};

TEST(FixedFields, RealsHaveTheFormOfFortran) {
  EXPECT_EQ(fixed_real(1.5, 12, 3), "   1.500E+00");
  EXPECT_EQ(fixed_real(-1.25e-7, 16, 4, 3), "    -1.2500E-007");
  EXPECT_EQ(fixed_real(0, 9, 1), "  0.0E+00");
  EXPECT_EQ(fixed_real(1e-300, 4, 1), "1.0E-300");
}

TEST(FixedFields, RealsHaveAPointInALocaleWithCommas) {
  const CommaLocale locale;
  if (*std::localeconv()->decimal_point != ',') GTEST_SKIP() << "no locale with commas is there";
  EXPECT_EQ(fixed_real(1.5, 12, 3), "   1.500E+00");
  EXPECT_EQ(inp_real(0.5), "0.5");
}

TEST(FixedFields, RealsOfAbaqusFitIntoTwentyCharacters) {
  EXPECT_EQ(inp_real(0.1), "0.1");
  EXPECT_EQ(inp_real(-12345.678), "-12345.678");
  EXPECT_EQ(inp_real(1.040810546875001e-05), "1.040810546875e-05");
  EXPECT_EQ(inp_real(0.0012345678901234567), "0.001234567890123457");
  EXPECT_EQ(inp_real(9.9999999999999995e-7), "1e-06");
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> digits(-1, 1), exponent(-60, 60);
  for (int i = 0; i < 100'000; ++i) {
    const double value = digits(random) * std::pow(10, exponent(random));
    const std::string field = inp_real(value);
    EXPECT_LE(field.size(), 20U);
    EXPECT_NEAR(std::strtod(field.c_str(), nullptr) / value, 1, 1e-13) << field;
  }
}

}  // namespace
}  // namespace mw::io
