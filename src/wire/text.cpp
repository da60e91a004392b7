// SPDX-License-Identifier: Apache-2.0
#include "wire/text.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "wire/sentence.h"

namespace theatron::wire {
namespace {

struct Row {
    TextCode code;
    Sentence text;
    Sentence advice = {};  // sentences that only operators can follow
};

// In the order of the codes.
constexpr Row rows[] = {
    {TextCode::as_written, {"{0}", "{0}", "{0}"}},

    {TextCode::host_too_old,
     {"This host is older than your Theatron (protocol {0}, you need {1}); update the host.",
      "Dieser Gastgeber ist älter als Ihr Theatron (Protokoll {0}, Sie brauchen {1}); er muss "
      "aktualisiert werden.",
      "Cet hôte est plus ancien que votre Theatron (protocole {0}, il vous faut {1}) ; il faut "
      "mettre l'hôte à jour."}},
    {TextCode::program_too_old,
     {"Your Theatron is too old for this host (protocol {0}, it needs {1}); update it.",
      "Ihr Theatron ist zu alt für diesen Gastgeber (Protokoll {0}, er braucht {1}); aktualisieren "
      "Sie es.",
      "Votre Theatron est trop ancien pour cet hôte (protocole {0}, il lui faut {1}) ; mettez-le à "
      "jour."}},
    {TextCode::wrong_token,
     {"The access code of this link is wrong; ask for the host's current link.",
      "Der Zugangscode dieses Links ist falsch; bitten Sie um den jetzigen Link des Gastgebers.",
      "Le code d'accès de ce lien est faux ; demandez le lien actuel de l'hôte."}},
    {TextCode::link_expired,
     {"This link has expired; ask for a new one.",
      "Dieser Link ist abgelaufen; bitten Sie um einen neuen.",
      "Ce lien a expiré ; demandez-en un nouveau."}},
    {TextCode::too_many_recordings,
     {"This session is recorded {0} times already, which is the most it allows; end another "
      "recording.",
      "Diese Sitzung wird schon {0}-mal aufgenommen; mehr sind nicht erlaubt. Beenden Sie eine "
      "andere Aufnahme.",
      "Cette séance est déjà enregistrée {0} fois, et pas plus n'est permis ; arrêtez un autre "
      "enregistrement."}},
    {TextCode::damaged_message,
     {"A message was {0}.", "Eine Nachricht war fehlerhaft ({0}).",
      "Un message était incorrect ({0})."}},
    {TextCode::not_joined,
     {"Join first.", "Treten Sie zuerst der Sitzung bei.", "Rejoignez d'abord la séance."}},
    {TextCode::joined_too_late,
     {"No join came in time.", "Der Beitritt kam nicht rechtzeitig.",
      "La demande de rejoindre la séance n'est pas arrivée à temps."}},
    {TextCode::too_many_requests,
     {"There were far more requests than a host answers.",
      "Es kamen weit mehr Anfragen, als ein Gastgeber beantwortet.",
      "Il y a eu bien plus de demandes qu'un hôte n'en traite."}},
    {TextCode::damaged_picture,
     {"A picture was {0}.", "Ein Bild war fehlerhaft ({0}).", "Une image était incorrecte ({0})."}},
    {TextCode::foreign_picture,
     {"A picture belongs to no camera of this participant.",
      "Ein Bild gehört zu keiner Kamera dieses Teilnehmers.",
      "Une image n'appartient à aucune caméra de ce participant."}},
    {TextCode::session_over,
     {"The host has ended the session.", "Der Gastgeber hat die Sitzung beendet.",
      "L'hôte a mis fin à la séance."}},
    {TextCode::no_reason,
     {"The host gave no reason.", "Der Gastgeber nannte keinen Grund.",
      "L'hôte n'a pas donné de raison."}},
    {TextCode::removed_by_operator,
     {"An operator has removed you from this session.",
      "Die Sitzungsleitung hat Sie aus dieser Sitzung entfernt.",
      "Un responsable vous a exclu de cette séance."}},
    {TextCode::link_revoked,
     {"The link by which you came is no longer valid; ask for a new one.",
      "Der Link, über den Sie kamen, gilt nicht mehr; bitten Sie um einen neuen.",
      "Le lien que vous avez utilisé n'est plus valable ; demandez-en un nouveau."}},
    {TextCode::not_let_in,
     {"An operator has not let you in.", "Die Sitzungsleitung hat Sie nicht eingelassen.",
      "Un responsable ne vous a pas admis."}},
    {TextCode::ended_by_operator,
     {"An operator has ended the session.", "Die Sitzungsleitung hat die Sitzung beendet.",
      "Un responsable a mis fin à la séance."}},
    {TextCode::session_has_ended,
     {"The session has ended; an operator must begin another one.",
      "Die Sitzung ist beendet; die Sitzungsleitung muss eine neue beginnen.",
      "La séance est terminée ; un responsable doit en commencer une autre."}},
    {TextCode::observer_records,
     {"An observer cannot record; ask for a link of an expert.",
      "Beobachter können nicht aufnehmen; bitten Sie um einen Link für Experten.",
      "Un observateur ne peut pas enregistrer ; demandez un lien d'expert."}},
    {TextCode::too_many_visitors,
     {"Too many people wait to be let in; try again later.",
      "Zu viele Personen warten auf Einlass; versuchen Sie es später noch einmal.",
      "Trop de personnes attendent d'être admises ; réessayez plus tard."}},
    {TextCode::all_places_taken,
     {"All {0} places of this session are taken; the last ones are kept for operators. Try again "
      "when somebody has left.",
      "Alle {0} Plätze dieser Sitzung sind belegt; die letzten sind der Sitzungsleitung "
      "vorbehalten. Versuchen Sie es noch einmal, wenn jemand gegangen ist.",
      "Les {0} places de cette séance sont prises ; les dernières sont réservées aux responsables. "
      "Réessayez quand quelqu'un sera parti."}},
    {TextCode::link_full,
     {"{0} participants are in by this link, which is as many as one link admits; ask for a link "
      "of your own.",
      "Über diesen Link sind {0} Teilnehmer da, mehr lässt ein Link nicht ein; bitten Sie um einen "
      "eigenen Link.",
      "{0} participants sont entrés par ce lien, et un lien n'en admet pas plus ; demandez un lien "
      "à vous."}},
    {TextCode::person_is_in_often,
     {"You are in this session {0} times already, and record or send cameras each time; end one of "
      "these first.",
      "Sie sind schon {0}-mal in dieser Sitzung und nehmen jedes Mal auf oder senden Kameras; "
      "beenden Sie zuerst eines davon.",
      "Vous êtes déjà {0} fois dans cette séance, et chaque fois vous enregistrez ou envoyez des "
      "caméras ; arrêtez d'abord l'une de ces connexions."}},
    {TextCode::came_in_again,
     {"You came into this session once more; a person can be in {0} times, so the oldest view "
      "ends.",
      "Sie sind noch einmal in diese Sitzung gekommen; eine Person kann {0}-mal da sein, darum "
      "endet die älteste Ansicht.",
      "C'est une entrée de plus dans cette séance ; une personne peut y être {0} fois, donc votre "
      "vue la plus ancienne se ferme."}},
    {TextCode::host_may_return,
     {"The host's program was stopped, perhaps to be started again.",
      "Das Programm des Gastgebers wurde angehalten, vielleicht um neu zu starten.",
      "Le programme de l'hôte a été arrêté, peut-être pour être relancé."}},

    {TextCode::camera_silent,
     {"It sends no pictures.", "Sie sendet keine Bilder.", "Elle n'envoie pas d'images."}},
    {TextCode::camera_repeating,
     {"It sends the same picture again and again.", "Sie sendet immer wieder dasselbe Bild.",
      "Elle envoie toujours la même image."}},
    {TextCode::camera_time_jump,
     {"Its pictures come late, or their times are wrong.",
      "Ihre Bilder kommen zu spät, oder ihre Zeiten stimmen nicht.",
      "Ses images arrivent en retard, ou leurs heures sont fausses."}},
    {TextCode::camera_gone, {"It does not answer.", "Sie antwortet nicht.", "Elle ne répond pas."}},
    {TextCode::recording_lost_one,
     {"Its recording is damaged: 1 picture is lost.",
      "Ihre Aufnahme ist beschädigt: 1 Bild ist verloren.",
      "Son enregistrement est endommagé : 1 image est perdue."}},
    {TextCode::recording_lost_pictures,
     {"Its recording is damaged: {0} pictures are lost.",
      "Ihre Aufnahme ist beschädigt: {0} Bilder sind verloren.",
      "Son enregistrement est endommagé : {0} images sont perdues."}},
    {TextCode::camera_number_too_high,
     {"The camera {0} has the number {1}, beyond all that there are; it cannot be shown.",
      "Die Kamera {0} hat die Nummer {1}, höher als alle, die es gibt; sie kann nicht gezeigt "
      "werden.",
      "La caméra {0} a le numéro {1}, au-delà de tous ceux qui existent ; elle ne peut pas être "
      "affichée."}},
    {TextCode::camera_foreign_streams,
     {"The camera {0} names streams that are not its own; it cannot be shown.",
      "Die Kamera {0} nennt Datenströme, die ihr nicht gehören; sie kann nicht gezeigt werden.",
      "La caméra {0} nomme des flux qui ne sont pas les siens ; elle ne peut pas être affichée."}},
    {TextCode::camera_bad_rate,
     {"The camera {0} has an impossible frame rate; it cannot be shown.",
      "Die Kamera {0} hat eine unmögliche Bildrate; sie kann nicht gezeigt werden.",
      "La caméra {0} a une cadence d'images impossible ; elle ne peut pas être affichée."}},
    {TextCode::camera_bad_calibration,
     {"The camera {0} has a calibration that is {1}; it cannot be shown.",
      "Die Kamera {0} hat eine unbrauchbare Kalibrierung ({1}); sie kann nicht gezeigt werden.",
      "La caméra {0} a un étalonnage inutilisable ({1}) ; elle ne peut pas être affichée."}},
    {TextCode::one_camera_too_many,
     {"The camera {0} is one more than there can be; it cannot be shown.",
      "Die Kamera {0} ist eine mehr, als es geben kann; sie kann nicht gezeigt werden.",
      "La caméra {0} est une de plus qu'il ne peut y en avoir ; elle ne peut pas être affichée."}},
    {TextCode::camera_number_taken,
     {"The camera {0} has a number that another one has; it cannot be shown.",
      "Die Kamera {0} hat die Nummer einer anderen; sie kann nicht gezeigt werden.",
      "La caméra {0} a le numéro d'une autre ; elle ne peut pas être affichée."}},
    {TextCode::camera_too_many_pixels,
     {"The camera {0} has more pixels than there is room for beside the others; it cannot be "
      "shown.",
      "Die Kamera {0} hat mehr Pixel, als neben den anderen Platz haben; sie kann nicht "
      "gezeigt werden.",
      "La caméra {0} a plus de pixels qu'il ne reste de place à côté des autres ; elle ne peut pas "
      "être affichée."}},
    {TextCode::camera_moved,
     {"The camera was moved by {0} mm and {1} degrees.",
      "Die Kamera wurde um {0} mm und {1} Grad bewegt.",
      "La caméra a été déplacée de {0} mm et {1} degrés."},
     {" Put it back, or find its new place with 'theatron register LINK --refine PLACES --output "
      "NEW'. A nudge says that it is right as it is.",
      " Stellen Sie sie zurück, oder bestimmen Sie ihren neuen Ort mit 'theatron register LINK "
      "--refine PLACES --output NEW'. Ein kleines Verstellen (F6) sagt, dass sie richtig steht, "
      "wie sie ist.",
      " Remettez-la en place, ou cherchez sa nouvelle position avec 'theatron register LINK "
      "--refine PLACES --output NEW'. Un petit ajustement (F6) indique qu'elle est bien comme elle "
      "est."}},
    {TextCode::cameras_apart,
     {"Surfaces that {0} sees, too, are {1} mm apart.",
      "Flächen, die auch {0} sieht, liegen {1} mm auseinander.",
      "Des surfaces que {0} voit aussi sont à {1} mm d'écart."},
     {" Find the cameras' places again with 'theatron register LINK --output NEW' and the board.",
      " Bestimmen Sie die Orte der Kameras neu, mit 'theatron register LINK --output NEW' und der "
      "Tafel.",
      " Cherchez de nouveau la position des caméras avec 'theatron register LINK --output NEW' et "
      "la mire."}},
    {TextCode::camera_without_depth,
     {"The camera {0} has no depth, which this version cannot show.",
      "Die Kamera {0} misst keine Tiefe; das kann diese Version nicht zeigen.",
      "La caméra {0} n'a pas de profondeur ; cette version ne peut pas l'afficher."}},
    {TextCode::no_pictures_come,
     {"Its pictures do not arrive any more.", "Ihre Bilder kommen nicht mehr an.",
      "Ses images n'arrivent plus."}},
    {TextCode::camera_moved_far,
     {"The camera was moved by more than {0} mm, or turned, so far that its picture cannot be "
      "matched.",
      "Die Kamera wurde um mehr als {0} mm bewegt oder gedreht, so weit, dass ihr Bild nicht zu "
      "vergleichen ist.",
      "La caméra a été déplacée de plus de {0} mm, ou tournée, si loin que son image ne peut plus "
      "être comparée."},
     {" Put it back, find its place with the board and 'theatron register LINK --output NEW', or "
      "say that it is right as it is now: 'nudge {1} none'.",
      " Stellen Sie sie zurück, bestimmen Sie ihren Ort mit der Tafel und 'theatron register LINK "
      "--output NEW', oder sagen Sie, dass sie so richtig steht: 'nudge {1} none'.",
      " Remettez-la en place, cherchez sa position avec la mire et 'theatron register LINK "
      "--output NEW', ou dites qu'elle est bien comme elle est : 'nudge {1} none'."}},
    {TextCode::camera_covered,
     {"It is covered, or sees nothing: the watch over its place cannot compare.",
      "Sie ist verdeckt oder sieht nichts: Ihr Ort lässt sich nicht überwachen.",
      "Elle est couverte, ou ne voit rien : sa position ne peut pas être surveillée."}},
    {TextCode::camera_moved_together,
     {"The camera was moved by {0} mm and {1} degrees together with {2}, or everything that both "
      "see was.",
      "Die Kamera wurde um {0} mm und {1} Grad bewegt, zusammen mit {2}; oder alles, was beide "
      "sehen, wurde bewegt.",
      "La caméra a été déplacée de {0} mm et {1} degrés en même temps que {2}, ou tout ce que les "
      "deux voient a été déplacé."},
     {" Put both back, or find their places with the board and 'theatron register LINK --output "
      "NEW'. If they stand where they stood, say so of each: 'nudge {3} none'.",
      " Stellen Sie beide zurück, oder bestimmen Sie ihre Orte mit der Tafel und 'theatron "
      "register LINK --output NEW'. Stehen sie, wo sie standen, so sagen Sie es für jede: 'nudge "
      "{3} none'.",
      " Remettez les deux en place, ou cherchez leurs positions avec la mire et 'theatron register "
      "LINK --output NEW'. Si elles sont là où elles étaient, dites-le pour chacune : 'nudge {3} "
      "none'."}},

    {TextCode::no_picture_came,
     {"None of its pictures has arrived yet.", "Noch keines ihrer Bilder ist angekommen.",
      "Aucune de ses images n'est encore arrivée."}},
    {TextCode::all_encodings_taken,
     {"The host already encodes in {0} ways; instead of {1} you get the nearest of them.",
      "Der Gastgeber kodiert schon auf {0} Arten; statt {1} erhalten Sie die nächste davon.",
      "L'hôte encode déjà de {0} manières ; au lieu de {1}, vous recevez la plus proche d'entre "
      "elles."}},
    {TextCode::encoding_is_slow,
     {"Encoding {0} takes {1} ms a picture here, more than its share, so you get fewer pictures "
      "than the cameras take; another codec would be faster.",
      "Die Kodierung {0} braucht hier {1} ms für ein Bild, mehr als ihren Anteil; darum erhalten "
      "Sie weniger Bilder, als die Kameras aufnehmen. Ein anderer Codec wäre schneller.",
      "L'encodage {0} prend ici {1} ms par image, plus que sa part ; vous recevez donc moins "
      "d'images que les caméras n'en prennent. Un autre codec serait plus rapide."}},
    {TextCode::frames_were_late,
     {"frames took {0} ms to arrive", "Bilder brauchten {0} ms bis hierher",
      "les images ont mis {0} ms à arriver"}},
    {TextCode::ceiling,
     {"your ceiling is {0} Mbit/s", "Ihre Obergrenze ist {0} Mbit/s",
      "votre plafond est de {0} Mbit/s"}},
    {TextCode::link_has_room,
     {"there is room for more", "es ist Platz für mehr", "il y a de la place pour davantage"}},
    {TextCode::link_is_tried,
     {"trying whether more arrives in time", "es wird versucht, ob mehr rechtzeitig ankommt",
      "essai pour voir si davantage arrive à temps"}},
    {TextCode::trial_failed,
     {"your link or computer did not take more",
      "Ihre Leitung oder Ihr Rechner nahm nicht mehr auf",
      "votre ligne ou votre ordinateur n'a pas pu en recevoir davantage"}},
    {TextCode::everything_is_sent, {"everything", "alles", "tout"}},
    {TextCode::half_of_frames,
     {"half of the frames", "die Hälfte der Bilder", "la moitié des images"}},
    {TextCode::quarter_of_frames,
     {"a quarter of the frames", "ein Viertel der Bilder", "un quart des images"}},
    {TextCode::one_frame_of, {"one frame of {0}", "eines von {0} Bildern", "une image sur {0}"}},
    {TextCode::coarser_color, {"colour as {0}", "Farbe als {0}", "couleur en {0}"}},
    {TextCode::loss_outside_region,
     {"bounded loss outside the region", "begrenzter Verlust außerhalb des wichtigen Bereichs",
      "perte limitée hors de la zone d'intérêt"}},
    {TextCode::codecs_are_set,
     {"The codecs are set by the study.", "Die Codecs sind durch die Studie festgelegt.",
      "Les codecs sont fixés par l'étude."}},

    {TextCode::link_without_cameras,
     {"Your role here lets you send no cameras; use the host's link for publishers, or ask an "
      "operator for that role.",
      "Ihre Rolle erlaubt hier nicht, Kameras zu senden; nehmen Sie den Link für Kameras, oder "
      "bitten Sie die Sitzungsleitung um diese Rolle.",
      "Votre rôle ne vous permet pas d'envoyer des caméras ici ; utilisez le lien de l'hôte pour "
      "les caméras, ou demandez ce rôle à un responsable."}},
    {TextCode::no_camera_offered,
     {"No camera was offered.", "Es wurde keine Kamera angeboten.",
      "Aucune caméra n'a été proposée."}},
    {TextCode::too_many_own_cameras,
     {"A participant can send {0} cameras at once.",
      "Ein Teilnehmer kann {0} Kameras zugleich senden.",
      "Un participant peut envoyer {0} caméras à la fois."}},
    {TextCode::session_full,
     {"The session has {0} cameras, which is the most it allows.",
      "Die Sitzung hat {0} Kameras; mehr sind nicht erlaubt.",
      "La séance a {0} caméras, et pas plus n'est permis."}},
    {TextCode::no_camera_numbers,
     {"Cameras have come and gone so often that no number is free at the moment; try again in some "
      "minutes.",
      "Kameras kamen und gingen so oft, dass im Moment keine Nummer frei ist; versuchen Sie es in "
      "einigen Minuten noch einmal.",
      "Des caméras sont venues et parties si souvent qu'aucun numéro n'est libre pour le moment ; "
      "réessayez dans quelques minutes."}},
    {TextCode::offered_too_often,
     {"Cameras were offered too often; wait a little.",
      "Kameras wurden zu oft angeboten; warten Sie ein wenig.",
      "Des caméras ont été proposées trop souvent ; attendez un peu."}},
    {TextCode::face_beyond_limits,
     {"The picture of a face is a screen of at most {0} pixels, {1} times a second.",
      "Das Bild eines Gesichts darf höchstens {0} Pixel haben und {1}-mal in der Sekunde "
      "kommen.",
      "L'image d'un visage a au plus {0} pixels, {1} fois par seconde."}},
    {TextCode::one_face,
     {"A participant shows one face; withdraw the first one.",
      "Ein Teilnehmer zeigt ein Gesicht; ziehen Sie das erste zurück.",
      "Un participant montre un seul visage ; retirez d'abord le premier."}},
    {TextCode::too_many_faces,
     {"The session shows {0} faces, which is the most it allows; you are seen without a picture.",
      "Die Sitzung zeigt {0} Gesichter, mehr sind nicht erlaubt; Sie werden ohne Bild gesehen.",
      "La séance montre {0} visages, et pas plus n'est permis ; on vous voit sans image."}},
    {TextCode::face_forbidden,
     {"Observers show no face; ask the operator to make you an expert.",
      "Beobachter zeigen kein Gesicht; bitten Sie die Sitzungsleitung, Sie zum Experten zu "
      "machen.",
      "Les observateurs ne montrent pas de visage ; demandez à un responsable de vous nommer "
      "expert."}},
    {TextCode::host_without_faces,
     {"This host is too old to show your face; you are seen without a picture.",
      "Dieser Gastgeber ist zu alt, um Ihr Gesicht zu zeigen; Sie werden ohne Bild gesehen.",
      "Cet hôte est trop ancien pour montrer votre visage ; on vous voit sans image."}},
    {TextCode::screen_beyond_limits,
     {"A screen shown from a browser has at most {0} pixels, {1} times a second.",
      "Ein Bildschirm aus dem Browser darf höchstens {0} Pixel haben und {1}-mal in der "
      "Sekunde kommen.",
      "Un écran partagé depuis un navigateur a au plus {0} pixels, {1} fois par seconde."}},
    {TextCode::one_screen,
     {"A browser shows one screen; end the first one.",
      "Ein Browser zeigt einen Bildschirm; beenden Sie zuerst den anderen.",
      "Un navigateur partage un seul écran ; arrêtez d'abord le premier."}},
    {TextCode::screen_forbidden,
     {"Observers show no screen; ask the operator to make you an expert.",
      "Beobachter zeigen keinen Bildschirm; bitten Sie die Sitzungsleitung, Sie zum Experten zu "
      "machen.",
      "Les observateurs ne partagent pas d'écran ; demandez à un responsable de vous nommer "
      "expert."}},
    {TextCode::host_without_screens,
     {"This host is too old to take a screen from a browser.",
      "Dieser Gastgeber ist zu alt, um einen Bildschirm aus dem Browser anzunehmen.",
      "Cet hôte est trop ancien pour recevoir un écran d'un navigateur."}},

    {TextCode::object_gone,
     {"That object is gone", "Dieses Objekt gibt es nicht mehr", "Cet objet n'existe plus"}},
    {TextCode::held_by_another,
     {"Somebody else holds this", "Jemand anders hält das", "Quelqu'un d'autre tient cet objet"}},
    {TextCode::not_held,
     {"You no longer hold this", "Sie halten das nicht mehr", "Vous ne tenez plus cet objet"}},
    {TextCode::role_forbids,
     {"Your role does not allow this", "Ihre Rolle erlaubt das nicht",
      "Votre rôle ne le permet pas"}},
    {TextCode::person_gone,
     {"That person has left", "Diese Person ist gegangen", "Cette personne est partie"}},
    {TextCode::room_full,
     {"The room holds no more objects, or no more of yours: remove some first",
      "Der Raum fasst keine weiteren Objekte, oder keine weiteren von Ihnen: Entfernen Sie zuerst "
      "einige",
      "La salle ne contient pas plus d'objets, ou pas plus des vôtres : supprimez-en d'abord"}},
    {TextCode::beyond_room_limits,
     {"The object would be out of the room's limits",
      "Das Objekt läge außerhalb der Grenzen des Raums",
      "L'objet serait hors des limites de la salle"}},
    {TextCode::room_too_often,
     {"That was too much at once; try again",
      "Das war zu viel auf einmal; versuchen Sie es noch einmal",
      "C'était trop à la fois ; réessayez"}},
    {TextCode::part_of_recording,
     {"Only the recording moves this", "Das bewegt nur die Aufnahme",
      "Seul l'enregistrement déplace cet objet"}},
    {TextCode::part_of_case,
     {"This belongs to the case; hide it, or close the case",
      "Das gehört zum Fall; verbergen Sie es, oder schließen Sie den Fall",
      "Cela fait partie du cas ; masquez-le, ou fermez le cas"}},
    {TextCode::of_another,
     {"Somebody else made this", "Das hat jemand anders gemacht", "Quelqu'un d'autre a fait cela"}},
    {TextCode::mark_stays,
     {"A mark stays as it was made; it can only be removed",
      "Eine Marke bleibt, wie sie gemacht wurde; sie lässt sich nur entfernen",
      "Une annotation reste telle qu'elle a été faite ; on peut seulement la supprimer"}},
    {TextCode::screen_pinned,
     {"This screen is pinned; its sharer or an operator unpins it",
      "Dieser Bildschirm ist festgemacht; wer ihn teilt oder die Sitzungsleitung kann ihn lösen",
      "Cet écran est fixé ; la personne qui le partage ou un responsable peut le libérer"}},
    {TextCode::screen_of_another,
     {"Only the person who shares this and operators may do that",
      "Das darf nur, wer den Bildschirm teilt, und die Sitzungsleitung",
      "Seuls la personne qui partage cet écran et les responsables peuvent le faire"}},

    {TextCode::operators_decide,
     {"Only operators decide on others.", "Über andere entscheidet nur die Sitzungsleitung.",
      "Seuls les responsables décident pour les autres."}},
    {TextCode::decided_person_gone,
     {"That person has left.", "Diese Person ist gegangen.", "Cette personne est partie."}},
    {TextCode::person_is_in,
     {"That person is in the session already.", "Diese Person ist schon in der Sitzung.",
      "Cette personne est déjà dans la séance."}},
    {TextCode::person_waits,
     {"That person must be let in first.", "Diese Person muss zuerst eingelassen werden.",
      "Cette personne doit d'abord être admise."}},
    {TextCode::not_on_yourself,
     {"Another operator must do this for you.",
      "Das muss jemand anders von der Sitzungsleitung für Sie tun.",
      "Un autre responsable doit le faire pour vous."}},
    {TextCode::decided_too_often,
     {"Those were too many decisions at once; try again.",
      "Das waren zu viele Entscheidungen auf einmal; versuchen Sie es noch einmal.",
      "C'étaient trop de décisions à la fois ; réessayez."}},
    {TextCode::adjusted_camera_gone,
     {"That camera has left, or cannot be adjusted.",
      "Diese Kamera ist nicht mehr da oder lässt sich nicht verstellen.",
      "Cette caméra n'est plus là, ou ne peut pas être ajustée."}},
    {TextCode::beyond_adjustment,
     {"A camera can be moved by 0.3 m and turned by 15 degrees; beyond that, register it anew. "
      "Only the host's own cameras have a region, and it lies in their picture.",
      "Eine Kamera lässt sich um 0,3 m verschieben und um 15 Grad drehen; darüber hinaus "
      "registrieren Sie sie neu. Nur die Kameras des Gastgebers haben einen Bereich, und er liegt "
      "in ihrem Bild.",
      "Une caméra peut être déplacée de 0,3 m et tournée de 15 degrés ; au-delà, recalez-la. "
      "Seules les caméras de l'hôte ont une zone, qui se trouve dans leur image."}},
    {TextCode::operators_adjust,
     {"Only operators adjust cameras.", "Kameras verstellt nur die Sitzungsleitung.",
      "Seuls les responsables ajustent les caméras."}},
    {TextCode::role_plays_not,
     {"Your role does not allow to play the recording.",
      "Ihre Rolle erlaubt nicht, die Aufnahme abzuspielen.",
      "Votre rôle ne permet pas de lire l'enregistrement."}},
    {TextCode::nothing_to_play,
     {"This host plays no recording.", "Dieser Gastgeber spielt keine Aufnahme ab.",
      "Cet hôte ne lit pas d'enregistrement."}},
    {TextCode::nothing_kept,
     {"The host keeps nothing of the last minute that you may see.",
      "Der Gastgeber hat von der letzten Minute nichts behalten, was Sie sehen dürfen.",
      "L'hôte n'a rien gardé de la dernière minute que vous puissiez voir."}},
    {TextCode::shows_no_study,
     {"The program of this participant is too old to show a study; update it.",
      "Das Programm dieses Teilnehmers ist zu alt, um eine Studie zu zeigen; aktualisieren Sie "
      "es.",
      "Le programme de ce participant est trop ancien pour afficher une étude ; mettez-le à "
      "jour."}},
    {TextCode::other_study,
     {"This participant takes part in a study that another operator's program leads.",
      "Dieser Teilnehmer nimmt an einer Studie teil, die das Programm einer anderen "
      "Sitzungsleitung leitet.",
      "Ce participant prend part à une étude que dirige le programme d'un autre responsable."}},
    {TextCode::condition_codec,
     {"The host does not know a codec of this condition.",
      "Der Gastgeber kennt einen Codec dieser Bedingung nicht.",
      "L'hôte ne connaît pas un codec de cette condition."}},
    {TextCode::large_step,
     {"This step of the study has too much text to be sent; shorten it.",
      "Dieser Schritt der Studie hat zu viel Text, um gesendet zu werden; kürzen Sie ihn.",
      "Cette étape de l'étude a trop de texte pour être envoyée ; raccourcissez-le."}},
    {TextCode::draws_flat,
     {"The participant has the 2D view, where a condition's renderer and depth codec mean nothing; "
      "let the participant enter the room.",
      "Der Teilnehmer hat die 2D-Ansicht, in der Darstellung und Tiefencodec einer Bedingung "
      "nichts bedeuten; er muss den Raum betreten.",
      "Le participant a la vue en 2D, où le rendu et le codec de profondeur d'une condition n'ont "
      "pas de sens ; il doit entrer dans la salle."}},
};

constexpr bool is_in_order() {
    for (std::size_t i = 1; i < std::size(rows); ++i)
        if (rows[i - 1].code >= rows[i].code)
            return false;
    return true;
}
static_assert(is_in_order());

constexpr bool is_in_every_language() {
    for (const Row& row : rows)
        if (!row.text.is_complete() || !(row.advice.is_complete() || row.advice.is_empty()))
            return false;
    return true;
}
static_assert(is_in_every_language());

// The two classes of texts on why a connection ends.
constexpr TextCode for_good[] = {
    TextCode::host_too_old,  TextCode::program_too_old,     TextCode::wrong_token,
    TextCode::session_over,  TextCode::removed_by_operator, TextCode::link_revoked,
    TextCode::not_let_in,    TextCode::ended_by_operator,   TextCode::session_has_ended,
    TextCode::came_in_again,
};
constexpr TextCode for_now[] = {
    TextCode::link_expired,     TextCode::too_many_recordings, TextCode::damaged_message,
    TextCode::not_joined,       TextCode::joined_too_late,     TextCode::too_many_requests,
    TextCode::damaged_picture,  TextCode::foreign_picture,     TextCode::no_reason,
    TextCode::observer_records, TextCode::too_many_visitors,   TextCode::all_places_taken,
    TextCode::link_full,        TextCode::person_is_in_often,  TextCode::host_may_return,
};

constexpr bool is_each_end_in_one_class() {
    constexpr int first = 100, end = 200;
    for (const Row& row : rows) {
        const auto in = [&](const auto& list) {
            int found = 0;
            for (const TextCode code : list)
                found += code == row.code;
            return found;
        };
        const bool ends = int(row.code) >= first && int(row.code) < end;
        if (in(for_good) + in(for_now) != int(ends))
            return false;
    }
    return true;
}
static_assert(is_each_end_in_one_class());

// Null if there is none.
const Row* find(TextCode code) {
    const auto* row =
        std::lower_bound(std::begin(rows), std::end(rows), code,
                         [](const Row& r, TextCode wanted) { return r.code < wanted; });
    return row == std::end(rows) || row->code != code ? nullptr : row;
}

// A number of a newer program. {0}: the number and the arguments.
constexpr Sentence unknown_texts[] = {
    {"The other program says something that this version of Theatron does not know (number {0}); a "
     "newer version can show it.",
     "Das andere Programm sagt etwas, das diese Version von Theatron nicht kennt (Nummer {0}); "
     "eine "
     "neuere Version kann es zeigen.",
     "L'autre programme dit quelque chose que cette version de Theatron ne connaît pas (numéro "
     "{0}) ; une version plus récente peut l'afficher."},
    {"The host ends the connection for a reason that this version of Theatron does not know "
     "(number {0}); a newer version can show it.",
     "Der Gastgeber beendet die Verbindung aus einem Grund, den diese Version von Theatron nicht "
     "kennt (Nummer {0}); eine neuere Version kann ihn zeigen.",
     "L'hôte met fin à la connexion pour une raison que cette version de Theatron ne connaît pas "
     "(numéro {0}) ; une version plus récente peut l'afficher."},
    {"Something is wrong with a camera that this version of Theatron does not know (number {0}); a "
     "newer version can show it.",
     "Mit einer Kamera stimmt etwas nicht, das diese Version von Theatron nicht kennt (Nummer "
     "{0}); eine neuere Version kann es zeigen.",
     "Une caméra a un problème que cette version de Theatron ne connaît pas (numéro {0}) ; une "
     "version plus récente peut l'afficher."},
    {"The host has changed what it sends for a reason that this version of Theatron does not know "
     "(number {0}); a newer version can show it.",
     "Der Gastgeber sendet etwas anderes aus einem Grund, den diese Version von Theatron nicht "
     "kennt (Nummer {0}); eine neuere Version kann ihn zeigen.",
     "L'hôte a changé ce qu'il envoie pour une raison que cette version de Theatron ne connaît pas "
     "(numéro {0}) ; une version plus récente peut l'afficher."},
    {"The host does not take the cameras for a reason that this version of Theatron does not know "
     "(number {0}); a newer version can show it.",
     "Der Gastgeber nimmt die Kameras nicht an aus einem Grund, den diese Version von Theatron "
     "nicht kennt (Nummer {0}); eine neuere Version kann ihn zeigen.",
     "L'hôte n'accepte pas les caméras pour une raison que cette version de Theatron ne connaît "
     "pas (numéro {0}) ; une version plus récente peut l'afficher."},
    {"The host does not allow this change of the room for a reason that this version of Theatron "
     "does not know (number {0}); a newer version can show it.",
     "Der Gastgeber erlaubt diese Änderung des Raums nicht aus einem Grund, den diese Version von "
     "Theatron nicht kennt (Nummer {0}); eine neuere Version kann ihn zeigen.",
     "L'hôte ne permet pas ce changement dans la salle pour une raison que cette version de "
     "Theatron ne connaît pas (numéro {0}) ; une version plus récente peut l'afficher."},
    {"The host does not carry out this decision for a reason that this version of Theatron does "
     "not know (number {0}); a newer version can show it.",
     "Aus einem Grund, den diese Version von Theatron nicht kennt (Nummer {0}), führt der "
     "Gastgeber diese Entscheidung nicht aus; eine neuere Version kann ihn zeigen.",
     "L'hôte n'exécute pas cette décision pour une raison que cette version de Theatron ne connaît "
     "pas (numéro {0}) ; une version plus récente peut l'afficher."},
};

std::string unknown(const Text& text, Language which) {
    const auto subject = std::size_t(text.code) / 100;
    std::string number = std::to_string(int(text.code));
    for (const std::string& argument : text.arguments)
        number += ", " + argument;
    return filled_in(unknown_texts[subject < std::size(unknown_texts) ? subject : 0].in(which),
                     {number});
}

}  // namespace

bool is_known(TextCode code) {
    return find(code) != nullptr;
}

bool is_for_good(TextCode code) {
    return std::find(std::begin(for_good), std::end(for_good), code) != std::end(for_good);
}

Text as_written(std::string sentence) {
    if (sentence.empty())
        return {};
    return {TextCode::as_written, {std::move(sentence)}};
}

std::string english(const Text& text) {
    return sentence(text, Language::english);
}

std::string english_without_advice(const Text& text) {
    return sentence_without_advice(text, Language::english);
}

std::string sentence(const Text& text, Language which) {
    const Row* row = find(text.code);
    return sentence_without_advice(text, which) +
           (row ? filled_in(row->advice.in(which), text.arguments) : "");
}

std::string sentence_without_advice(const Text& text, Language which) {
    if (text.empty())
        return {};
    const Row* row = find(text.code);
    return row ? filled_in(row->text.in(which), text.arguments) : unknown(text, which);
}

}  // namespace theatron::wire
