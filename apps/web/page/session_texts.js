// SPDX-License-Identifier: Apache-2.0
// The client's own texts in other languages than English; names of people, cameras and cases stay as they are.
import { language } from "./texts.js";

const german = {
    exact: {
        "Host": "Gastgeber", "Cameras": "Kameras", "Age of picture": "Alter des Bildes", "Received": "Empfangen",
        "Drawn": "Gezeichnet", "Data": "Daten", "Dropped": "Ausgelassen", "Depth": "Tiefe", "Colour": "Farbe",
        "Filter": "Filter", "Drawing": "Darstellung", "Decoding": "Dekodierung", "Help": "Hilfe", "You": "Sie",
        "Not live": "Nicht live", "Recording": "Aufnahme", "Connection": "Verbindung", "Sent": "Gesendet", "At the door": "An der Tür",
        "Microphone": "Mikrofon", "Under the mouse": "Unter der Maus",
        "Choice of colour": "Wahl der Farbe", "JPEG: all pictures come in time": "JPEG: alle Bilder kommen rechtzeitig",
        "JPEG: this browser does not decode H.264": "JPEG: dieser Browser dekodiert kein H.264",
        "JPEG: the browser's decoder failed with H.264": "JPEG: der Decoder des Browsers versagte bei H.264",
        "none": "keine", "unknown": "unbekannt", "connecting": "wird aufgebaut", "waiting": "wartet", "default": "üblich",
        "several": "mehrere", "in the page": "in der Seite", "no surface": "keine Oberfläche",
        "People": "Personen", "Places": "Orte", "Case": "Fall", "Marks": "Marken", "Parts": "Teile", "Images": "Bilder",
        "Nobody else is here": "Niemand sonst ist hier", "There are no cameras": "Es gibt keine Kameras",
        "Calls you (J: go there)": "Ruft Sie (J: hingehen)",
        "Go": "Hingehen", "Go to": "Hingehen", "Go there": "Hingehen", "Stay here": "Hierbleiben", "See through": "Mitsehen",
        "Let in": "Einlassen", "Refuse": "Abweisen", "Mute": "Stummschalten", "Unmute": "Sprechen lassen",
        "Remove": "Entfernen", "Really remove": "Wirklich entfernen", "Make expert": "Zum Experten machen", "Make observer": "Zum Beobachter machen",
        "Show my face": "Mein Gesicht zeigen", "Hide my face": "Mein Gesicht verbergen", "You are seen": "Sie werden gesehen",
        "Webcam": "Webcam", "you are seen": "Sie werden gesehen", "is being opened": "wird geöffnet",
        "Look back (you alone)": "Zurückblicken (nur Sie)", "The present": "Die Gegenwart", "Live": "Live",
        "10 s ago": "vor 10 s", "30 s ago": "vor 30 s", "60 s ago": "vor 60 s",
        "People and voices are of now": "Personen und Stimmen sind von jetzt",
        "NOT LIVE: looking back...": "NICHT LIVE: Rückblick ...", "NOT LIVE: looking back.... End: live again": "NICHT LIVE: Rückblick ...",
        "Call all to me": "Alle zu mir rufen", "Stop calling": "Nicht mehr rufen",
        "Open": "Öffnen", "Close": "Schließen", "Show": "Zeigen", "Hide": "Verbergen", "Apart": "Auseinander",
        "Together": "Zusammen", "Life size": "Lebensgröße", "Cut": "Schneiden", "Whole": "Ganz", "Window": "Fenster",
        "Axial": "Axial", "Coronal": "Koronal", "Sagittal": "Sagittal", "Closer": "Näher",
        "Draw": "Zeichnen", "Pin": "Nadel", "Arrow": "Pfeil", "Distance": "Abstand", "Stroke": "Strich", "Undo": "Zurück",
        "Screens": "Bildschirme", "Smaller": "Kleiner", "Larger": "Größer", "Pin in place": "Festmachen", "Unpin": "Lösen",
        "End share": "Nicht mehr teilen", "you share it": "Sie teilen ihn", "of the host": "des Gastgebers", "you hold it": "Sie halten ihn", "pinned": "festgemacht",
        "P shows the screens, with buttons that end their shares": "P zeigt die Bildschirme, mit Knöpfen zum Beenden",
        "Clear mine": "Meine löschen", "Clear all": "Alle löschen",
        "The host offers no case": "Der Gastgeber bietet keinen Fall an",
        "Waiting for the first picture…": "Das erste Bild wird erwartet…",
        "Connecting…": "Die Verbindung wird aufgebaut…",
        "Connection lost, trying again…": "Die Verbindung ist unterbrochen und wird neu aufgebaut…",
        "No connection yet, trying again…": "Noch keine Verbindung, neuer Versuch…",
        "Waiting to be let in…": "Bitte warten, bis Sie eingelassen werden…",
        "The operating room decides. Esc: leave.": "Der Operationssaal entscheidet. Esc: verlassen.",
        "The host does not let you in": "Der Gastgeber lässt Sie nicht ein",
        "The session is over": "Die Sitzung ist beendet",
        "This computer draws too slowly; the connection is not the cause":
            "Dieser Rechner zeichnet zu langsam; an der Verbindung liegt es nicht",
        "You are muted; nobody hears you.": "Sie sind stummgeschaltet; niemand hört Sie.",
        "The others hear you again.": "Die anderen hören Sie wieder.",
        "Nobody calls you.": "Niemand ruft Sie.", "Nobody waits to be let in.": "Niemand wartet darauf, eingelassen zu werden.",
        "You ask the others to come to you; they decide.": "Sie bitten die anderen, zu Ihnen zu kommen; diese entscheiden.",
        "You no longer call.": "Sie rufen nicht mehr.", "This person has left": "Diese Person ist gegangen",
        "This is not in the room any more": "Das ist nicht mehr im Raum", "From above": "Von oben", "Live again": "Wieder live",
        "Your role does not allow to call others.": "Ihre Rolle erlaubt nicht, andere zu rufen.",
        "Observers show no face; ask the operator to make you an expert.":
            "Beobachter zeigen kein Gesicht; bitten Sie einen Operator, Sie zum Experten zu machen.",
        "This host is too old to show your face; you are seen without a picture.":
            "Dieser Gastgeber ist zu alt, um Ihr Gesicht zu zeigen; Sie werden ohne Bild gesehen.",
        "There is no such mark": "Diese Marke gibt es nicht", "You have made no mark": "Sie haben keine Marke gemacht",
        "Point at a part of an organ with images": "Zeigen Sie auf den Teil eines Organs, das Bilder hat",
        "Hold an object with the left mouse button first": "Halten Sie zuerst ein Objekt mit der linken Maustaste",
        "Nobody is near who could take this": "Niemand ist nahe genug, um das zu nehmen",
        "Sitting": "Sitzend", "Standing": "Stehend", "Beside the table": "Neben dem Tisch",
        "operator": "Operator", "expert": "Experte", "observer": "Beobachter", "muted": "stumm", "records": "nimmt auf",
        "not in the room": "nicht im Raum", "view is old": "Ansicht ist alt", "asks all to come": "ruft alle",
        "holds an object": "hält ein Objekt", "you see through their eyes": "Sie sehen mit ihren Augen",
    },
    patterns: [
        [/^This picture is (.+) old$/, "Dieses Bild ist $1 alt"],
        [/^This picture is (.+) old\. /, "Dieses Bild ist $1 alt. "],
        [/^NOT LIVE: (.+) ago$/, "NICHT LIVE: vor $1"],
        [/^NOT LIVE: (.+) ago\. End: live again$/, "NICHT LIVE: vor $1. Ende: wieder live"],
        [/^NOT LIVE: (.+) ago \(not drawn: live camera (.+?)\)$/, "NICHT LIVE: vor $1 (nicht gezeichnet: Kamera $2, die live ist)"],
        [/^NOT LIVE: (.+) ago \(not drawn: live camera (.+?)\)\. End: live again$/, "NICHT LIVE: vor $1 (nicht gezeichnet: Kamera $2, die live ist). Ende: wieder live"],
        [/^NOT LIVE: camera (.+) is not drawn until it is live(?:\. End: live again)?$/, "NICHT LIVE: Kamera $1 wird erst gezeichnet, wenn sie live ist"],
        [/^Frozen by you: this picture is (.+) old\. Space: live again$/, "Von Ihnen angehalten: dieses Bild ist $1 alt. Leertaste: wieder live"],
        [/^born (.+), number (.+)$/, "geboren am $1, Nummer $2"],
        [/^born (.+)$/, "geboren am $1"],
        [/^number (.+)$/, "Nummer $1"],
        [/^(\d+) live$/, "$1 laufen"],
        [/^(\d+) recording$/, "$1 aus einer Aufzeichnung"],
        [/^(\d+) paused$/, "$1 aus einer angehaltenen Aufzeichnung"],
        [/^RECORDING ([\d:]+ \/ [\d:]+)$/, "AUFZEICHNUNG $1"],
        [/^RECORDING ([\d:]+ \/ [\d:]+), paused at its end$/, "AUFZEICHNUNG $1, zu Ende"],
        [/^RECORDING ([\d:]+ \/ [\d:]+), paused by (.+)$/, "AUFZEICHNUNG $1, angehalten von $2"],
        [/^(\d+) workers?$/, "$1 Helfer"],
        [/^holds (\d+) objects$/, "hält $1 Objekte"],
        [/^shared by (.+)$/, "geteilt von $1"],
        [/^(.+) holds it$/, "$1 hält ihn"],
        [/^([\d.]+) m wide$/, "$1 m breit"],
        [/^(.+), as you chose$/, "$1, wie Sie wählten"],
        [/^H\.264: (\d+) pictures a second, (\d+) as JPEG$/, "H.264: $1 Bilder pro Sekunde, als JPEG $2"],
        [/^The host chooses: only (\d+) pictures a second came as JPEG$/,
            "Der Gastgeber wählt: als JPEG kamen nur $1 Bilder pro Sekunde"],
        [/^(\d+) fps$/, "$1 Bilder/s"],
        [/^(.+) \(auto\), coarser$/, "$1 (automatisch), gröber"],
        [/^(.+) \(auto\)$/, "$1 (automatisch)"],
        [/^(.+), coarser$/, "$1, gröber"],
        [/^Given to (.+)$/, "An $1 gegeben"],
        [/^You have let in (.+)$/, "Sie haben $1 eingelassen"],
        [/^You have not let in (.+)$/, "Sie haben $1 nicht eingelassen"],
        [/^You see through the eyes of (.+)$/, "Sie sehen mit den Augen von $1"],
        [/^Camera (.+)$/, "Kamera $1"],
        [/^The audit log cannot be written: (.+)\. Its entries wait until it can, and those too many are counted\.$/,
            "Das Protokoll kann nicht geschrieben werden: $1. Seine Einträge warten, bis es geht, und überzählige werden gezählt."],
        [/^The room cannot be saved and would be lost with the host; its log says why\.$/,
            "Der Raum kann nicht gesichert werden und ginge mit dem Gastgeber verloren; dessen Log sagt den Grund."],
        [/^View of (.+)$/, "Ansicht von $1"],
    ],
};

// A text of the client in the page's language; English where there is no translation. Lists with commas are
// translated part by part.
export function session_text(english) {
    if (language !== "de" || !english)
        return english;
    const part = one => {
        if (one in german.exact)
            return german.exact[one];
        for (const [pattern, text] of german.patterns)
            if (pattern.test(one))
                return one.replace(pattern, text);
        return null;
    };
    return part(english) ?? english.split(", ").map(one => part(one) ?? one).join(", ");
}
