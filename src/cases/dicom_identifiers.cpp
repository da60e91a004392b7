// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_identifiers.h"

#include <gdcmDataSet.h>
#include <gdcmSequenceOfItems.h>

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

void add(const gdcm::DataSet& data, const KnownTag& tag, std::vector<Identifier>& found) {
    const gdcm::Tag place(tag.group, tag.element);
    if (found.size() == max_identifiers || !data.FindDataElement(place))
        return;
    const gdcm::ByteValue* value = data.GetDataElement(place).GetByteValue();
    if (!value)
        return;
    std::string text(value->GetPointer(),
                     std::min<std::size_t>(value->GetLength(), max_dicom_text));
    while (!text.empty() && (text.back() == ' ' || text.back() == '\0'))
        text.pop_back();
    Identifier identifier{tag.name, std::move(text)};
    if (!identifier.value.empty() &&
        std::find(found.begin(), found.end(), identifier) == found.end())
        found.push_back(std::move(identifier));
}

void add_of_sequences(const gdcm::DataSet& data, int depth, std::vector<Identifier>& found) {
    if (depth == deepest_sequence)
        return;
    for (const gdcm::DataElement& element : data.GetDES()) {
        if (element.IsEmpty())
            continue;
        const auto* sequence = dynamic_cast<const gdcm::SequenceOfItems*>(&element.GetValue());
        if (!sequence)
            continue;
        for (gdcm::SequenceOfItems::SizeType i = 1; i <= sequence->GetNumberOfItems(); ++i) {
            const gdcm::DataSet& item = sequence->GetItem(i).GetNestedDataSet();
            for (const KnownTag& tag : identifying_inside)
                add(item, tag, found);
            add_of_sequences(item, depth + 1, found);
        }
    }
}

}  // namespace

std::vector<Identifier> identifiers_in(const gdcm::DataSet& data) {
    std::vector<Identifier> found;
    for (const KnownTag& tag : identifying)
        add(data, tag, found);
    add_of_sequences(data, 0, found);
    return found;
}

}  // namespace theatron::cases
