// SPDX-License-Identifier: Apache-2.0
// itk_reader FORMAT FILE: reads a file as ITK does (FORMAT: dicom, nifti, nrrd), and prints as JSON
// what is in it: the number of values, the smallest, the largest and their mean, the number of
// values above one half, and the volume of a sample. Ends with 1 where ITK does not read it. For
// compare_readers.py alone.
#include <itkGDCMImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using Component = itk::IOComponentEnum;

itk::ImageIOBase::Pointer reader_of(const std::string& format) {
    if (format == "dicom")
        return itk::GDCMImageIO::New().GetPointer();
    if (format == "nifti")
        return itk::NiftiImageIO::New().GetPointer();
    if (format == "nrrd")
        return itk::NrrdImageIO::New().GetPointer();
    return nullptr;
}

template <class T>
void append(const std::vector<char>& bytes, std::vector<double>& values) {
    const T* const begin = reinterpret_cast<const T*>(bytes.data());
    values.assign(begin, begin + bytes.size() / sizeof(T));
}

bool values_of(const std::vector<char>& bytes, Component type, std::vector<double>& values) {
    switch (type) {
        case Component::UCHAR:
            append<std::uint8_t>(bytes, values);
            return true;
        case Component::CHAR:
            append<std::int8_t>(bytes, values);
            return true;
        case Component::USHORT:
            append<std::uint16_t>(bytes, values);
            return true;
        case Component::SHORT:
            append<std::int16_t>(bytes, values);
            return true;
        case Component::UINT:
            append<std::uint32_t>(bytes, values);
            return true;
        case Component::INT:
            append<std::int32_t>(bytes, values);
            return true;
        case Component::ULONG:
        case Component::ULONGLONG:
            append<std::uint64_t>(bytes, values);
            return true;
        case Component::LONG:
        case Component::LONGLONG:
            append<std::int64_t>(bytes, values);
            return true;
        case Component::FLOAT:
            append<float>(bytes, values);
            return true;
        case Component::DOUBLE:
            append<double>(bytes, values);
            return true;
        default:
            return false;
    }
}

int read(const std::string& format, const std::string& file) {
    const itk::ImageIOBase::Pointer io = reader_of(format);
    if (!io || !io->CanReadFile(file.c_str()))
        return 1;
    io->SetFileName(file);
    io->ReadImageInformation();
    itk::ImageIORegion region(io->GetNumberOfDimensions());
    double volume = 1;
    for (unsigned i = 0; i < io->GetNumberOfDimensions(); ++i) {
        region.SetSize(i, io->GetDimensions(i));
        volume *= i < 3 ? std::abs(io->GetSpacing(i)) : 1;
    }
    io->SetIORegion(region);
    std::vector<char> bytes(std::size_t(io->GetImageSizeInBytes()));
    io->Read(bytes.data());
    std::vector<double> values;
    if (!values_of(bytes, io->GetComponentType(), values) || values.empty())
        return 1;
    double sum = 0;
    std::size_t above = 0;
    for (const double value : values) {
        sum += value;
        above += value > 0.5;
    }
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    std::printf("[%zu, %.17g, %.17g, %.17g, %zu, %.17g]\n", values.size(), *low, *high,
                sum / double(values.size()), above, volume);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3)
        return 2;
    try {
        return read(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
