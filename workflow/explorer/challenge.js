"use strict";

// A wish about the rebound, and whether the present impact fulfils it.
const challenge = (() => {
})();
