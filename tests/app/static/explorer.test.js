// A whole explorer under a person's hands: what it asks, paints and writes is what is kept in tests/pictures/kept.
import test from "node:test"

import {isKept} from "./played/kept.js"
import {story} from "./played/wiring.js"

test("what becomes of an explorer is what is kept", () => isKept(story(), "explorer.txt"))
