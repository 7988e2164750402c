#include "frames/foreign_format.hpp"

#include <array>

namespace tactile_net::frames {
namespace {

struct Signature {
  std::string_view start;
  std::string_view what;
  std::string_view what_to_do;
};

using namespace std::string_view_literals;

constexpr std::string_view as_csv = "save the table as CSV (UTF-8) where it was made";
constexpr std::string_view from_utf16 =
    "save it as UTF-8, or convert it: iconv -f UTF-16 -t UTF-8 FILE > readings.csv";
constexpr std::string_view zipped =
    "of a .npz take one array: numpy.save('readings.npy', numpy.load('FILE.npz')['NAME']); of a "
    "spreadsheet (.xlsx, .ods) save the sheet as CSV; of an archive take the file out";
constexpr std::string_view in_python = "write the array as .npy: numpy.save('readings.npy', array)";

constexpr std::array<Signature, 17> signatures = {{
    {"\xff\xfe"sv, "is UTF-16 text", from_utf16},
    {"\xfe\xff"sv, "is UTF-16 text", from_utf16},
    {"PK\x03\x04"sv, "is a zip archive, as .npz and .xlsx files are", zipped},
    {"PK\x05\x06"sv, "is an empty zip archive", zipped},
    {"\x1f\x8b"sv, "is compressed by gzip", "unpack it: gunzip -c FILE > readings.csv"},
    {"BZh"sv, "is compressed by bzip2", "unpack it: bunzip2 -c FILE > readings.csv"},
    {"\xfd\x37zXZ"sv, "is compressed by xz", "unpack it: xz -dc FILE > readings.csv"},
    {"\x28\xb5\x2f\xfd"sv, "is compressed by zstd", "unpack it: zstd -dc FILE > readings.csv"},
    {"\xd0\xcf\x11\xe0"sv, "is an old Office file (.xls)", as_csv},
    {"\x89HDF"sv, "is HDF5, as MATLAB's newer .mat files are", in_python},
    {"MATLAB "sv, "is a MATLAB file (.mat)", "in MATLAB: writematrix(readings, 'readings.csv')"},
    {"PAR1"sv, "is Parquet", in_python},
    {"ARROW1"sv, "is Arrow", in_python},
    {"SQLite format 3"sv, "is an SQLite database", as_csv},
    {"%PDF"sv, "is a PDF", as_csv},
    {"\x80\x04\x95"sv, "is a Python pickle", in_python},
    {"<?xml"sv, "is XML", as_csv},
}};

}  // namespace

std::optional<ForeignFormat> foreign_format(std::string_view start) {
  for (const Signature& one : signatures)
    if (start.starts_with(one.start))
      return ForeignFormat{std::string(one.what), std::string(one.what_to_do)};
  const std::size_t zero = start.substr(0, 4096).find('\0');
  if (zero == start.npos) return std::nullopt;
  // Latin text in UTF-16 without its mark: every second byte is zero.
  if (zero <= 1 && start.size() > 3 && start[zero + 2] == '\0')
    return ForeignFormat{"is UTF-16 text", std::string(from_utf16)};
  return ForeignFormat{"holds a zero byte: it is not text",
                       "readings are a CSV file or a .npy array"};
}

}  // namespace tactile_net::frames
