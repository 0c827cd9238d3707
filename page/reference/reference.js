/** Shows the reference of the API from the service's own description. */

window.SwaggerUIBundle({
  url: "/openapi.json",
  dom_id: "#reference",
  deepLinking: true,
  validatorUrl: null, // would send the address elsewhere
  tryItOutEnabled: true,
  defaultModelsExpandDepth: 0,
});
