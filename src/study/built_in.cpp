// SPDX-License-Identifier: Apache-2.0
#include "study/built_in.h"

#include <cassert>

namespace theatron::study {
namespace {

// clang-format off
constexpr std::string_view built_in =
    R"(questionnaire = ipq
title = Igroup Presence Questionnaire
source = Schubert, Friedmann and Regenbrecht (2001): The experience of presence: factor analytic insights. Presence 10(3), 266-281
texts-at = https://www.igroup.org/pq/ipq/download.php
lowest = 0
highest = 6
scale = general | General presence
scale = spatial | Spatial presence
scale = involvement | Involvement
scale = realism | Experienced realism
item = G1 general
item = SP1 spatial
item = SP2 spatial
reversed = yes
item = SP3 spatial
item = SP4 spatial
item = SP5 spatial
item = INV1 involvement
item = INV2 involvement
item = INV3 involvement
reversed = yes
item = INV4 involvement
item = REAL1 realism
reversed = yes
item = REAL2 realism
item = REAL3 realism
item = REAL4 realism
)"
    R"(questionnaire = networked-minds
title = Networked Minds Measure of Social Presence
source = Harms and Biocca (2004): Internal consistency and reliability of the Networked Minds measure of social presence. Seventh Annual International Workshop Presence 2004
texts-at = the cited paper, in the proceedings of Presence 2004 (International Society for Presence Research)
lowest = 1
highest = 7
scale = copresence | Co-presence
scale = attention | Attentional allocation
scale = message | Perceived message understanding
scale = affect | Perceived affective understanding
scale = emotion | Perceived emotional interdependence
scale = behaviour | Perceived behavioural interdependence
item = CP1 copresence
item = CP2 copresence
item = CP3 copresence
item = CP4 copresence
item = CP5 copresence
item = CP6 copresence
item = AA1 attention
reversed = yes
item = AA2 attention
reversed = yes
item = AA3 attention
item = AA4 attention
item = AA5 attention
reversed = yes
item = AA6 attention
reversed = yes
item = PMU1 message
item = PMU2 message
item = PMU3 message
item = PMU4 message
item = PMU5 message
reversed = yes
item = PMU6 message
reversed = yes
item = PAU1 affect
item = PAU2 affect
item = PAU3 affect
reversed = yes
item = PAU4 affect
reversed = yes
item = PAU5 affect
item = PAU6 affect
item = PEI1 emotion
item = PEI2 emotion
item = PEI3 emotion
item = PEI4 emotion
item = PEI5 emotion
item = PEI6 emotion
item = PBI1 behaviour
item = PBI2 behaviour
item = PBI3 behaviour
item = PBI4 behaviour
item = PBI5 behaviour
item = PBI6 behaviour
)"
    R"(questionnaire = ssq
title = Simulator Sickness Questionnaire
source = Kennedy, Lane, Berbaum and Lilienthal (1993): Simulator sickness questionnaire: an enhanced method for quantifying simulator sickness. International Journal of Aviation Psychology 3(3), 203-220
texts-at = table of symptoms in the cited paper
lowest = 0
highest = 3
scale = nausea | Nausea
from = sum
factor = 9.54
scale = oculomotor | Oculomotor
from = sum
factor = 7.58
scale = disorientation | Disorientation
from = sum
factor = 13.92
scale = total | Total
from = sum
factor = 3.74
item = S1 nausea oculomotor total total
item = S2 oculomotor total
item = S3 oculomotor total
item = S4 oculomotor total
item = S5 oculomotor disorientation total total
item = S6 nausea total
item = S7 nausea total
item = S8 nausea disorientation total total
item = S9 nausea oculomotor total total
item = S10 disorientation total
item = S11 oculomotor disorientation total total
item = S12 disorientation total
item = S13 disorientation total
item = S14 disorientation total
item = S15 nausea total
item = S16 nausea total
)"
    R"(questionnaire = vrsq
title = Virtual Reality Sickness Questionnaire
source = Kim, Park, Choi and Choe (2018): Virtual reality sickness questionnaire (VRSQ): motion sickness measurement index in a virtual reality environment. Applied Ergonomics 69, 66-73
texts-at = table of symptoms in the cited paper
lowest = 0
highest = 3
scale = oculomotor | Oculomotor
from = sum
factor = 100/12
scale = disorientation | Disorientation
from = sum
factor = 100/15
scale = total | Total
from = mean of oculomotor disorientation
item = V1 oculomotor
item = V2 oculomotor
item = V3 oculomotor
item = V4 oculomotor
item = V5 disorientation
item = V6 disorientation
item = V7 disorientation
item = V8 disorientation
item = V9 disorientation
)"
    R"(questionnaire = nasa-tlx
title = NASA Task Load Index, without weights
source = Hart and Staveland (1988): Development of NASA-TLX. Advances in Psychology 52, 139-183; without weights: Hart (2006), Proceedings of the Human Factors and Ergonomics Society 50(9), 904-908
texts-at = https://humansystems.arc.nasa.gov/groups/tlx/
lowest = 0
step = 5
highest = 100
scale = load | Task load
scale = mental | Mental demand
scale = physical | Physical demand
scale = temporal | Temporal demand
scale = performance | Performance
scale = effort | Effort
scale = frustration | Frustration
item = mental mental load
item = physical physical load
item = temporal temporal load
item = performance performance load
item = effort effort load
item = frustration frustration load
)"
    R"(questionnaire = sus
title = System Usability Scale
source = Brooke (1996): SUS: a quick and dirty usability scale. In: Usability Evaluation in Industry, Taylor and Francis, 189-194
texts-at = the cited chapter
lowest = 1
highest = 5
scale = usability | Usability
from = sum
factor = 2.5
zero-based = yes
item = U1 usability
item = U2 usability
reversed = yes
item = U3 usability
item = U4 usability
reversed = yes
item = U5 usability
item = U6 usability
reversed = yes
item = U7 usability
item = U8 usability
reversed = yes
item = U9 usability
item = U10 usability
reversed = yes
)"
    R"(questionnaire = about-you
title = About you
lowest = 1
highest = 2
item = age
text = How old are you?
choices = under 25 | 25 to 34 | 35 to 44 | 45 to 54 | 55 or more
item = sex
text = Which sex do you give?
choices = female | male | another | no answer
item = operations
text = How often are you in an operating room?
choices = never | a few times so far | every month | every week
item = headsets
text = How often have you worn a headset for virtual or augmented reality?
choices = never | once | a few times | often
)"
    R"(questionnaire = own-presence
title = Presence, in our own words
lowest = 0
highest = 6
anchors = not at all | completely
scale = place | In the place
scale = together | Together with the other person
scale = comfort | Comfort
scale = clarity | Clarity of the picture
item = place1 place
text = While I watched, the operating room was the place where I was.
item = place2 place
text = I could have pointed to where things stood around me.
item = place3 place
text = I looked at a picture rather than into a room.
reversed = yes
item = together1 together
text = The other person and I were in the same room.
item = together2 together
text = I noticed what the other person paid attention to.
item = together3 together
text = The other person seemed far away.
reversed = yes
item = comfort1 comfort
text = I felt sick or dizzy.
reversed = yes
item = comfort2 comfort
text = My eyes were strained.
reversed = yes
item = clarity1 clarity
text = I could make out the details that the task needed.
item = clarity2 clarity
text = People and things looked as they do in reality.
item = clarity3 clarity
text = Grain, holes or flicker disturbed me.
reversed = yes
)"
    R"(questionnaire = own-benefit
title = Benefit, in our own words
lowest = 0
highest = 6
scale = benefit | Benefit against video
item = benefit1 benefit
text = Compared with a video call, how well could you help?
anchors = far worse | far better
item = benefit2 benefit
text = Compared with a video call, how well did you understand where things are?
anchors = far worse | far better
item = use
text = How often would you use it, if you had it?
choices = never | rarely | from time to time | often | at every occasion
item = best
text = For which occasion would it help you most?
choices = emergencies | advice to a less experienced colleague | teaching | anatomy | talking with patients | practising by hand | none
)"
    R"(questionnaire = own-preference
title = Preference, in our own words
lowest = 0
highest = 6
scale = preference | Preference
item = preference preference
text = Which of the two presentations did you prefer?
anchors = clearly the first that I saw | clearly the last that I saw
)";
// clang-format on

}  // namespace

std::string_view built_in_text() {
    return built_in;
}

Questionnaires built_in_questionnaires() {
    Questionnaires known;
    [[maybe_unused]] const auto mistakes = add_questionnaires(built_in, known);
    assert(mistakes.empty());
    return known;
}

}  // namespace theatron::study
