"use strict";

// A superball between a floor and a table.
const superball = (() => {
})();
