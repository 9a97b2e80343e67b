"use strict";
const result = JSON.parse(document.getElementById("result").textContent);
