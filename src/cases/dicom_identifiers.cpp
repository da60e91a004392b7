// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_identifiers.h"

#include <algorithm>

namespace theatron::cases {
namespace {

constexpr int deepest_sequence = 8;

struct KnownTag {
    const char* name;
    std::uint16_t group, element;
};

constexpr KnownTag identifying[] = {{"PatientName", 0x0010, 0x0010},
                                    {"PatientID", 0x0010, 0x0020},
                                    {"PatientBirthDate", 0x0010, 0x0030},
                                    {"PatientSex", 0x0010, 0x0040},
                                    {"PatientAge", 0x0010, 0x1010},
                                    {"OtherPatientIDs", 0x0010, 0x1000},
                                    {"OtherPatientNames", 0x0010, 0x1001},
                                    {"PatientAddress", 0x0010, 0x1040},
                                    {"PatientBirthName", 0x0010, 0x1005},
                                    {"PatientMotherBirthName", 0x0010, 0x1060},
                                    {"PatientTelephoneNumbers", 0x0010, 0x2154},
                                    {"ResponsiblePerson", 0x0010, 0x2297},
                                    {"AdmissionID", 0x0038, 0x0010},
                                    {"PerformingPhysicianName", 0x0008, 0x1050},
                                    {"OperatorsName", 0x0008, 0x1070},
                                    {"StudyDate", 0x0008, 0x0020},
                                    {"StudyDescription", 0x0008, 0x1030},
                                    {"SeriesDescription", 0x0008, 0x103e},
                                    {"AccessionNumber", 0x0008, 0x0050},
                                    {"InstitutionName", 0x0008, 0x0080},
                                    {"ReferringPhysicianName", 0x0008, 0x0090},
                                    {"StudyInstanceUID", 0x0020, 0x000d},
                                    {"SeriesInstanceUID", 0x0020, 0x000e},
                                    {"FrameOfReferenceUID", 0x0020, 0x0052}};

// In sequences, whose patient may be another one than the file's.
constexpr KnownTag identifying_inside[] = {{"OtherPatientNames", 0x0010, 0x0010},
                                           {"OtherPatientIDs", 0x0010, 0x0020},
                                           {"OtherPatientIDs", 0x0010, 0x1000},
                                           {"OtherPatientNames", 0x0010, 0x1001},
                                           {"OtherPatientNames", 0x0010, 0x1005}};

void add(const DicomSet& set, const KnownTag& tag, std::vector<Identifier>& found) {
    if (found.size() == max_identifiers)
        return;
    const DicomTag place = DicomTag(tag.group) << 16 | tag.element;
    Identifier identifier{tag.name, set.text(place, max_dicom_text)};
    if (!identifier.value.empty() &&
        std::find(found.begin(), found.end(), identifier) == found.end())
        found.push_back(std::move(identifier));
}

void add_of_sequences(const DicomSet& set, int depth, std::vector<Identifier>& found) {
    if (depth == deepest_sequence)
        return;
    for (const DicomElement& element : set.elements()) {
        // Texts begin otherwise than an item does.
        if (element.tag == pixel_data_tag)
            continue;
        for (const DicomSet& inside : set.items(element)) {
            for (const KnownTag& tag : identifying_inside)
                add(inside, tag, found);
            add_of_sequences(inside, depth + 1, found);
        }
    }
}

}  // namespace

std::vector<Identifier> identifiers_in(const DicomSet& set) {
    std::vector<Identifier> found;
    for (const KnownTag& tag : identifying)
        add(set, tag, found);
    add_of_sequences(set, 0, found);
    return found;
}

}  // namespace theatron::cases
