/** Shows the reference of the API from the service's own description; requests show the tab's key. */

import { keyHeaders } from "../requests/key.js";

window.SwaggerUIBundle({
  url: "/openapi.json",
  dom_id: "#reference",
  validatorUrl: null, // would send the address elsewhere
  tryItOutEnabled: true,
  defaultModelsExpandDepth: 0,
  requestInterceptor: (request) => {
    const here = new URL(request.url, location.href).origin === location.origin;
    if (here) request.headers = { ...keyHeaders(), ...request.headers };
    return request;
  },
  onComplete: () => {
    // no level of headings is left out, and all is in landmarks
    for (const one of document.querySelectorAll(".opblock-tag, .models > h4")) one.setAttribute("aria-level", "2");
    const about = document.querySelector(".information-container");
    about.setAttribute("role", "region");
    about.setAttribute("aria-label", "About the API");
  },
});
document.getElementById("key").hidden = !keyHeaders().Authorization;
