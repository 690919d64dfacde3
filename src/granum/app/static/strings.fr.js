// French of every text in the page scripts; a test fails when one is missing.
export const french = {
  'Calculate': 'Calculer', 'Lab data': 'Données de laboratoire', 'Lines': 'Lignes', 'Charts': 'Diagrammes', 'Exercises': 'Exercices', 'Select': 'Choisir',
  'Pages': 'Pages', 'Skip to content': 'Aller au contenu', 'Light or dark': 'Clair ou sombre', 'Loading…': 'Chargement…', 'Chart': 'Diagramme',
  'The server did not understand the request.': "Le serveur n'a pas compris la demande.",
  'Find': 'Chercher', 'Search cards': 'Chercher une carte', 'Search {count} cards…': 'Chercher parmi {count} cartes…', 'Nothing found.': 'Rien trouvé.',
  'Enter': 'Saisir', 'Believe': 'Juger', 'Unit of {name}': 'Unité de {name}', 'source covers': 'domaine de la source :',
  'Undo': 'Annuler', 'Example values': "Valeurs d'exemple", 'Copy link': 'Copier le lien', 'Keep to compare': 'Garder pour comparer', 'Comparison': 'Comparaison', 'case {number}': 'cas {number}', 'Clear': 'Effacer',
  'inside the range the source covers': 'dans le domaine couvert par la source', 'Equation': 'Équation', 'with': 'avec', 'Source': 'Source', 'About': 'À propos',
  'Drop a CSV or Excel file here, or choose one:': 'Déposez ici un fichier CSV ou Excel, ou choisissez-en un :', 'Remove': 'Retirer', 'or paste the table': 'ou collez le tableau',
  'The first line names the columns with their units:': 'La première ligne nomme les colonnes avec leurs unités :', 'Conditions': "Conditions de l'essai", 'Parameters with their 95 % intervals appear here.': 'Les paramètres et leurs intervalles à 95 % apparaissent ici.',
  'parameter': 'paramètre', 'value': 'valeur', 'standard error': 'erreur type', '95 % interval': 'intervalle à 95 %', 'unit': 'unité', 'Data and fit': 'Données et ajustement', 'Download the result': 'Télécharger le résultat',
  'Open a case file': 'Ouvrir un fichier de cas', 'Open…': 'Ouvrir…', 'Examples': 'Exemples', 'Workspace': 'Espace de travail', 'Solve': 'Résoudre', 'Cancel': 'Interrompre', 'Working…': 'Calcul en cours…', 'Report': 'Rapport', 'Save': 'Enregistrer', 'Saved.': 'Enregistré.', 'File name': 'Nom du fichier',
  'Case file': 'Fichier de cas', 'Open an example, or write a case file here.': 'Ouvrez un exemple, ou écrivez ici un fichier de cas.',
  'mass closes to {mass}, energy to {energy}': 'le bilan de matière boucle à {mass}, celui d’énergie à {energy}', 'Streams': 'Courants', 'stream': 'courant', 'solid': 'solide', 'liquid': 'liquide', 'gas': 'gaz', 'Equipment': 'Équipements',
  'temperature': 'température', 'pressure': 'pression', 'particle diameter': 'diamètre de particule', 'by mass': 'en masse', 'Particle sizes': 'Granulométrie',
  'optional': 'facultatif', 'no limit exceeded': 'aucune limite dépassée', 'Choices': 'Choix', 'Still to be given: {names}': 'Reste à donner : {names}', 'Cards found': 'Cartes trouvées', 'Copied.': 'Copié.', 'The same in Python': 'La même chose en Python', 'The same on the command line': 'La même chose en ligne de commande',
  'What other laws give': 'Ce que donnent les autres lois', 'No other law takes these inputs.': "Aucune autre loi n'accepte ces données.", 'outside its range': 'hors de son domaine', 'Calculate again': 'Recalculer', 'yes': 'oui', 'no': 'non',
  'Working… a new line takes a little while the first time.': 'Calcul en cours… une ligne nouvelle prend un peu de temps la première fois.', 'Start from an example': "Partir d'un exemple",
  'Worked examples': 'Exercices résolus', 'Questions': 'Questions', '{count} questions of the course': '{count} questions du cours', 'Show the answer': 'Montrer la réponse', 'Hide the answer': 'Cacher la réponse',
  'Show the calculation': 'Montrer le calcul', 'Hide the calculation': 'Cacher le calcul', 'Open in Calculate': 'Ouvrir dans Calculer', 'as printed in the course': 'telle qu’imprimée dans le cours',
  'Check': 'Vérifier', 'right': 'juste', 'wrong': 'faux', '{score} of {count} right': '{score} justes sur {count}',
  'materials': 'Matériaux', 'particles': 'Particules', 'porous': 'Milieux poreux', 'humid_gas': 'Gaz humide', 'streams': 'Courants', 'comminution': 'Broyage et criblage', 'settling': 'Décantation', 'cyclones': 'Cyclones', 'fluidization': 'Fluidisation', 'filtration': 'Filtration', 'centrifuges': 'Centrifugation', 'crystallization': 'Cristallisation', 'drying': 'Séchage', 'studies': 'Études',
};
// Keys that are not English sentences.
export const english = { materials: 'Materials', particles: 'Particles', porous: 'Porous media', humid_gas: 'Humid gas', streams: 'Streams', comminution: 'Comminution and screening', settling: 'Settling', cyclones: 'Cyclones', fluidization: 'Fluidization', filtration: 'Filtration', centrifuges: 'Centrifuges', crystallization: 'Crystallization', drying: 'Drying', studies: 'Studies' };
