// SPDX-License-Identifier: Apache-2.0
// Any text: reading the identifiers of a case ends with clean texts of bounded length, or none.
#include <cstdint>
#include <cstdlib>

#include "base/outside_text.h"
#include "cases/patient_texts.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto patient = cases::parse_patient_texts({reinterpret_cast<const char*>(data), size});
    if (!patient)
        return 0;
    // Separators may be added between the parts of a name.
    constexpr std::size_t most_characters = 400;
    for (const std::string& text : {patient->name, patient->birth_date, patient->id})
        if (clean_text(text, most_characters) != text)
            std::abort();
    if (*patient == cases::PatientTexts{})
        std::abort();
    return 0;
}
