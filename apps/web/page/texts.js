// SPDX-License-Identifier: Apache-2.0
// Every text of the page itself, by language. Sentences of the session come from the client.
const tables = {
    en: {
        your_name: "Your name",
        enter: "Enter the room",
        loading: "The program is being loaded…",
        invited: "You are invited to a session on {host}.",
        invited_as: "You are invited to a session on {host} as {role}.",
        no_token: "This address has no invitation in it. Open the whole link that the host gave you, with everything behind the '#'.",
        no_program: "The program could not be loaded: {why}",
        certificate_title: "About the browser's warning",
        certificate_text: "A host without a certificate of its own organisation makes one itself, and a browser warns of it. The connection is encrypted all the same. To be sure that it leads to the right host, compare the SHA-256 fingerprint of the certificate, which the browser shows behind the sign beside the address, with this one from the link:",
        people: "People (P)", case: "Case (O)", new_brick: "New brick (N)", marks: "Marks (Z)", home: "Start view (R)",
        full_screen: "Full screen", help: "Help", leave: "Leave", close: "Close", cameras: "Cameras",
        camera_line: "{fps} pictures a second, {age} old",
        no_picture: "no picture yet",
        you: "you",
        states: { live: "live", stale: "stale", ended: "ended", failed: "failed" },
        keys: [
            ["Left mouse button, one finger", "Turn around what is under the pointer; on an object: hold it"],
            ["Right mouse button, two fingers", "Move sideways, up and down"],
            ["Mouse wheel, pinch", "Come closer, go further away; with a held object: nearer, further"],
            ["W A S D or arrows, Q E", "Walk; Q down, E up; faster with Shift"],
            ["T, held", "Aim at a place on the floor; release to stand there"],
            ["N; G; Delete", "A new brick; give what you hold to the nearest person; remove it"],
            ["F, held", "Point at what is under the pointer: the others see it with your name"],
            ["Z; Backspace", "Marks: draw, point at places, measure; remove your newest mark"],
            ["X", "Sit or stand"],
            ["P, O", "People and places; the case"],
            ["K, J", "Call the others to you; go to the person who calls you"],
            ["Y, U", "Operators: let in the person at the door, or refuse"],
            ["R, 1 to 9", "Back to the start view; view of a camera"],
            ["M, C", "Next way of drawing; next depth codec"],
        ],
    },
    de: {
        your_name: "Ihr Name",
        enter: "Den Raum betreten",
        loading: "Das Programm wird geladen…",
        invited: "Sie sind zu einer Sitzung auf {host} eingeladen.",
        invited_as: "Sie sind zu einer Sitzung auf {host} eingeladen, als {role}.",
        no_token: "Diese Adresse enthält keine Einladung. Öffnen Sie den ganzen Link des Gastgebers, mit allem hinter dem '#'.",
        no_program: "Das Programm konnte nicht geladen werden: {why}",
        certificate_title: "Zur Warnung des Browsers",
        certificate_text: "Ein Gastgeber ohne Zertifikat seiner Organisation stellt selbst eines aus, und der Browser warnt davor. Die Verbindung ist trotzdem verschlüsselt. Vergleichen Sie den SHA-256-Fingerabdruck des Zertifikats, den der Browser hinter dem Zeichen neben der Adresse zeigt, mit diesem aus dem Link, um sicher zu sein, dass sie zum richtigen Gastgeber führt:",
        people: "Personen (P)", case: "Fall (O)", new_brick: "Neuer Baustein (N)", marks: "Marken (Z)", home: "Startansicht (R)",
        full_screen: "Vollbild", help: "Hilfe", leave: "Verlassen", close: "Schließen", cameras: "Kameras",
        camera_line: "{fps} Bilder pro Sekunde, {age} alt",
        no_picture: "noch kein Bild",
        you: "Sie",
        states: { live: "läuft", stale: "steht", ended: "beendet", failed: "ausgefallen" },
        keys: [
            ["Linke Maustaste, ein Finger", "Um das drehen, was unter dem Zeiger ist; auf einem Objekt: es halten"],
            ["Rechte Maustaste, zwei Finger", "Seitwärts, auf- und abwärts bewegen"],
            ["Mausrad, zwei Finger spreizen", "Näher, weiter weg; mit gehaltenem Objekt: näher, weiter"],
            ["W A S D oder Pfeile, Q E", "Gehen; Q abwärts, E aufwärts; schneller mit Umschalt"],
            ["T gehalten", "Auf eine Stelle am Boden zielen; loslassen, um dort zu stehen"],
            ["N; G; Entf", "Neuer Baustein; Gehaltenes der nächsten Person geben; es entfernen"],
            ["F gehalten", "Auf das zeigen, was unter dem Zeiger ist: die anderen sehen es mit Ihrem Namen"],
            ["Z; Rücktaste", "Markieren: zeichnen, Stellen zeigen, messen; die neueste eigene Marke entfernen"],
            ["X", "Sitzen oder stehen"],
            ["P, O", "Personen und Orte; der Fall"],
            ["K, J", "Die anderen zu sich rufen; zu der Person gehen, die ruft"],
            ["Y, U", "Operatoren: die Person an der Tür einlassen oder abweisen"],
            ["R, 1 bis 9", "Zurück zur Startansicht; Ansicht einer Kamera"],
            ["M, C", "Nächste Zeichenart; nächster Tiefen-Codec"],
        ],
    },
};

export const language = navigator.language.startsWith("de") ? "de" : "en";
export const texts = tables[language];

// The text with its {names} replaced.
export function text(key, values = {}) {
    return texts[key].replace(/\{(\w+)\}/g, (_, name) => values[name]);
}
